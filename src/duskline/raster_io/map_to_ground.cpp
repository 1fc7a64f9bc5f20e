// The ground beneath a map: places, and how far apart neighbouring ones are.
//
// Geographic coordinates are measured by the radii of curvature of the ellipsoid. For projected ones PROJ says
// where a place and its neighbours 500 m along the map's axes lie; chords between them in space, not
// differences of longitude, so that poles and the 180th meridian are places like any other.

#include <duskline/geometry/vector.h>
#include <duskline/raster_io/file_errors.h>
#include <duskline/raster_io/gdal_session.h>
#include <duskline/raster_io/map_to_ground.h>

#include <ogr_spatialref.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace duskline {

namespace {

constexpr double kStep_m = 500.0;

std::unique_ptr<OGRSpatialReference> horizontal_part(const OGRSpatialReference& crs)
{
    std::unique_ptr<OGRSpatialReference> part(crs.Clone());
    if (part->IsCompound())
        part->StripVertical();
    part->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return part;
}

std::string body_name(const OGRSpatialReference& crs, double radius_m)
{
    if (std::abs(radius_m / 6.375e6 - 1.0) < 0.002)
        return "Earth";
    if (std::abs(radius_m / 1.7374e6 - 1.0) < 0.002)
        return "Moon";
    if (std::abs(radius_m / 3.3962e6 - 1.0) < 0.006)
        return "Mars";
    const char* name = crs.GetAttrValue("SPHEROID");
    return name != nullptr ? on_one_line(name) : "unnamed body";
}

// The only maps whose axes run west and south whatever the place; polar maps have such names too, but mean
// "along a meridian".
bool counts_west_and_south(const OGRSpatialReference& crs)
{
    OGRAxisOrientation first = OAO_Other;
    OGRAxisOrientation second = OAO_Other;
    crs.GetAxis("PROJCS", 0, &first);
    crs.GetAxis("PROJCS", 1, &second);
    return (first == OAO_West && second == OAO_South) || (first == OAO_South && second == OAO_West);
}

} // namespace

MapToGround::MapToGround(const OGRSpatialReference& crs)
{
    const GdalErrors errors;
    const auto map = horizontal_part(crs);
    is_geographic_ = map->IsGeographic() && !map->IsDerivedGeographic();
    if (!is_geographic_ && !map->IsProjected())
        throw InputError("its coordinate system is neither geographic nor projected");

    equatorial_radius_m_ = map->GetSemiMajor();
    const double inverse_flattening = map->GetInvFlattening();
    const double flattening = inverse_flattening > 0.0 ? 1.0 / inverse_flattening : 0.0;
    squared_eccentricity_ = flattening * (2.0 - flattening);
    body_.name = body_name(*map, equatorial_radius_m_);
    body_.is_earth = body_.name == "Earth";
    body_.equatorial_radius_m = equatorial_radius_m_;
    radians_per_degree_unit_ = map->GetAngularUnits();
    prime_meridian_ = map->GetPrimeMeridian() * std::numbers::pi / 180.0;
    if (is_geographic_)
        return;

    metres_per_unit_ = map->GetLinearUnits();
    axis_sign_ = counts_west_and_south(*map) ? -1.0 : 1.0;
    const std::unique_ptr<OGRSpatialReference> geographic(map->CloneGeogCS());
    if (geographic) {
        geographic->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        to_geographic_.reset(OGRCreateCoordinateTransformation(map.get(), geographic.get()));
    }
    if (!to_geographic_)
        throw InputError("PROJ cannot go from its coordinate system back to longitude and latitude: "
                         + errors.reason("no reason given"));
}

MapToGround::~MapToGround() = default;

MapToGround::Curvature MapToGround::curvature(double latitude) const
{
    const double s = std::sin(latitude);
    const double w = 1.0 - squared_eccentricity_ * s * s;
    const double normal_m = equatorial_radius_m_ / std::sqrt(w);
    return {normal_m * (1.0 - squared_eccentricity_) / w, normal_m};
}

double MapToGround::local_radius_m(Angle latitude) const
{
    const Curvature c = curvature(latitude.radians());
    return std::sqrt(c.meridian_m * c.normal_m);
}

std::optional<MapScale> MapToGround::at(double x, double y) const
{
    if (!is_geographic_)
        return projected_scale(x, y);
    if (!(std::abs(y * radians_per_degree_unit_) < std::numbers::pi / 2.0 - 1e-9))
        return std::nullopt;
    return geographic_scale(x, y);
}

MapScale MapToGround::geographic_scale(double x, double y) const
{
    const double latitude = y * radians_per_degree_unit_;
    const double longitude =
        std::remainder(x * radians_per_degree_unit_ + prime_meridian_, 2.0 * std::numbers::pi);
    const Curvature c = curvature(latitude);
    return {{Angle::from_radians(longitude), Angle::from_radians(latitude)},
            {c.normal_m * std::cos(latitude) * radians_per_degree_unit_, 0.0},
            {0.0, c.meridian_m * radians_per_degree_unit_}};
}

std::optional<MapScale> MapToGround::projected_scale(double x, double y) const
{
    const double step = kStep_m / metres_per_unit_;
    std::array<double, 5> xs = {x, x - step, x + step, x, x};
    std::array<double, 5> ys = {y, y, y, y - step, y + step};
    std::array<int, 5> found{};
    const GdalErrors errors;
    to_geographic_->Transform(5, xs.data(), ys.data(), nullptr, found.data());

    std::array<Vector3, 5> in_space;
    for (std::size_t i = 0; i < 5; ++i) {
        if (!found[i] || !std::isfinite(xs[i]) || !std::isfinite(ys[i]))
            return std::nullopt;
        xs[i] = xs[i] * radians_per_degree_unit_ + prime_meridian_;
        ys[i] *= radians_per_degree_unit_;
        const double normal_m = curvature(ys[i]).normal_m;
        in_space[i] = {normal_m * std::cos(ys[i]) * std::cos(xs[i]),
                       normal_m * std::cos(ys[i]) * std::sin(xs[i]),
                       normal_m * (1.0 - squared_eccentricity_) * std::sin(ys[i])};
    }
    const Vector3 east = {-std::sin(xs[0]), std::cos(xs[0]), 0.0};
    const Vector3 north = {-std::sin(ys[0]) * std::cos(xs[0]), -std::sin(ys[0]) * std::sin(xs[0]),
                           std::cos(ys[0])};
    const auto per_unit = [&](std::size_t from, std::size_t to) {
        const Vector3 chord = (in_space[to] - in_space[from]) * (1.0 / (2.0 * step));
        return GroundVector{dot(chord, east), dot(chord, north)};
    };
    const double longitude = std::remainder(xs[0], 2.0 * std::numbers::pi);
    return MapScale{
        {Angle::from_radians(longitude), Angle::from_radians(ys[0])}, per_unit(1, 2), per_unit(3, 4)};
}

} // namespace duskline
