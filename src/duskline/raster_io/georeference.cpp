// From a geotransform and a coordinate system to cells of known size whose rows run south and columns east.
//
// One step along a row and one along a column of the file are two vectors on the ground. Their lengths are the
// cell size; which of them are turned round, and by how much the grid is rotated then, follows from where they
// point. All of it is measured at the raster's centre; how much it differs at the edges decides between
// silence, a warning and a refusal.

#include <duskline/raster_io/file_errors.h>
#include <duskline/raster_io/gdal_session.h>
#include <duskline/raster_io/georeference.h>
#include <duskline/raster_io/map_to_ground.h>
#include <duskline/raster_io/plain_number.h>

#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace duskline {

namespace {

constexpr double kStretchIgnored = 0.01;   // UTM stretches by 0.04 %, Albers by 1 %
constexpr double kVariationIgnored = 1.02; // widest cell over narrowest
constexpr double kVariationRefused = 2.0;
constexpr double kShearIgnored_deg = 0.5;
constexpr double kShearRefused_deg = 5.0;
constexpr double kHighLatitude_deg = 60.0;

double degrees(double radians)
{
    return radians * 180.0 / std::numbers::pi;
}

double length_m(GroundVector v)
{
    return std::hypot(v.east_m, v.north_m);
}

GroundVector sum(GroundVector a, double s, GroundVector b, double t)
{
    return {a.east_m * s + b.east_m * t, a.north_m * s + b.north_m * t};
}

// One step along a row (to the next column) and along a column (to the next row), on the ground.
struct CellSteps {
    GroundVector column;
    GroundVector row;
};

CellSteps cell_steps(const std::array<double, 6>& gt, GroundVector per_x, GroundVector per_y)
{
    return {sum(per_x, gt[1], per_y, gt[4]), sum(per_x, gt[2], per_y, gt[5])};
}

// How far from a right angle the steps are, degrees.
double shear_deg(const CellSteps& steps)
{
    const double along = steps.column.east_m * steps.row.east_m + steps.column.north_m * steps.row.north_m;
    return degrees(
        std::asin(std::min(1.0, std::abs(along) / (length_m(steps.column) * length_m(steps.row)))));
}

// The turn, clockwise, that takes an unrotated grid (columns east, rows south) to these steps.
double turn_deg(const CellSteps& steps)
{
    const double by_columns = std::atan2(-steps.column.north_m, steps.column.east_m);
    const double by_rows = std::atan2(-steps.row.east_m, -steps.row.north_m);
    return degrees(by_rows + std::remainder(by_columns - by_rows, 2.0 * std::numbers::pi) / 2.0);
}

// Turns rows or columns round so that the grid is no mirror image and rotated as little as can be.
void put_in_order(const CellSteps& steps, GroundFrame& frame)
{
    double least = std::numeric_limits<double>::infinity();
    for (const bool flip_rows : {false, true}) {
        for (const bool flip_columns : {false, true}) {
            CellSteps s = steps;
            if (flip_columns)
                s.column = {-s.column.east_m, -s.column.north_m};
            if (flip_rows)
                s.row = {-s.row.east_m, -s.row.north_m};
            if (s.column.east_m * s.row.north_m - s.column.north_m * s.row.east_m >= 0.0)
                continue;
            const double turn = turn_deg(s);
            if (std::abs(turn) < least - 1e-6) {
                least = std::abs(turn);
                frame.rows_flipped = flip_rows;
                frame.columns_flipped = flip_columns;
                frame.grid_north = Angle::from_degrees(least < 1e-9 ? 0.0 : turn);
            }
        }
    }
}

std::string quoted(const std::string& path)
{
    return "'" + path + "'";
}

std::string latitude_words(Angle latitude)
{
    return plain_number(latitude.degrees(), 1);
}

// A projection that treats the raster's centre well, as gdalwarp takes it.
std::string local_projection(const Place& centre, const Body& body)
{
    const double longitude = centre.longitude.degrees();
    const double latitude = centre.latitude.degrees();
    if (body.is_earth && std::abs(latitude) <= 84.0) {
        const int zone = std::clamp(static_cast<int>(std::floor((longitude + 180.0) / 6.0)) + 1, 1, 60);
        return "EPSG:" + std::to_string((latitude >= 0.0 ? 32600 : 32700) + zone);
    }
    return "'+proj=laea +lat_0=" + plain_number(latitude, 1) + " +lon_0=" + plain_number(longitude, 1)
           + (body.is_earth ? " +ellps=WGS84'" : " +R=" + plain_number(body.equatorial_radius_m, 0) + "'");
}

// What to do about a raster whose cells differ too much. Beyond some thousand kilometres no projection helps.
std::string warp_remedy(const Georeference& file, const GroundFrame& frame)
{
    const double height_m = static_cast<double>(file.rows) * frame.cell_size_m.y;
    const double width_m = static_cast<double>(file.columns) * frame.cell_size_m.x;
    if (std::max(height_m, width_m) > 5.0e6)
        return "cut out a smaller part, gdal_translate -projwin";
    std::string projection;
    if (frame.centre && frame.body)
        projection = "-t_srs " + local_projection(*frame.centre, *frame.body) + " ";
    return "gdalwarp " + projection + "-r bilinear " + quoted(file.path) + " projected.tif helps";
}

// Settles one file. Each step adds to `result` or throws.
class Settling {
public:
    Settling(const Georeference& file, std::optional<double> cell_size_m)
        : file_(file), cell_size_m_(cell_size_m)
    {}

    SettledGround run()
    {
        if (!has_geotransform())
            without_place();
        else if (file_.crs == nullptr || file_.crs->IsEmpty() || file_.crs->IsLocal())
            without_ellipsoid();
        else
            with_ellipsoid();
        if (cell_size_m_) {
            frame().cell_size_m = {*cell_size_m_, *cell_size_m_};
            note("cells taken as " + plain_number(*cell_size_m_, 6) + " m, as asked");
        }
        if (frame().grid_north.degrees() != 0.0)
            note("the raster is rotated: its rows' north lies at map azimuth "
                 + plain_number(wrapped_to_circle(frame().grid_north).degrees(), 3) + " degrees");
        return std::move(result_);
    }

private:
    GroundFrame& frame() { return result_.frame; }
    void note(std::string text) { result_.notes.push_back(std::move(text)); }
    void warn(std::string text) { result_.warnings.push_back(std::move(text)); }
    [[noreturn]] void refuse(const std::string& why) const
    {
        throw InputError(quoted(file_.path) + ": " + why);
    }

    const std::array<double, 6>& gt() const { return *file_.geotransform; }

    bool has_geotransform() const
    {
        constexpr std::array<double, 6> kPixels = {0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
        const bool has_crs = file_.crs != nullptr && !file_.crs->IsEmpty();
        return file_.geotransform && (has_crs || gt() != kPixels);
    }

    void without_place()
    {
        if (!cell_size_m_)
            warn(quoted(file_.path)
                 + " has no georeference: cells taken as 1 m, row 0 as north (--cell-size METRES says "
                   "otherwise)");
    }

    void without_ellipsoid()
    {
        const bool local = file_.crs != nullptr && file_.crs->IsLocal();
        const double unit_m = local ? file_.crs->GetLinearUnits() : 1.0;
        if (!local && !cell_size_m_ && looks_like_degrees())
            refuse("has no coordinate system, and its coordinates look like degrees, not metres; say so with "
                   "gdal_edit.py -a_srs EPSG:4326, or give --cell-size METRES");
        const CellSteps steps = cell_steps(gt(), {unit_m, 0.0}, {0.0, unit_m});
        require_cells(steps);
        settle_cells(steps);
        if (!cell_size_m_)
            note(local ? "a local coordinate system: cells of " + cells_words() + ", place unknown"
                       : "no coordinate system: its units taken as metres, cells of " + cells_words());
    }

    // Cells far below any survey's, at numbers that can be longitude and latitude.
    bool looks_like_degrees() const
    {
        const auto rows = static_cast<double>(file_.rows);
        const auto columns = static_cast<double>(file_.columns);
        const double x = std::max(std::abs(gt()[0]), std::abs(gt()[0] + columns * gt()[1] + rows * gt()[2]));
        const double y = std::max(std::abs(gt()[3]), std::abs(gt()[3] + columns * gt()[4] + rows * gt()[5]));
        const double cell = std::max(std::hypot(gt()[1], gt()[4]), std::hypot(gt()[2], gt()[5]));
        return x <= 361.0 && y <= 90.01 && cell < 0.1 && (x > 2.0 || y > 2.0);
    }

    void with_ellipsoid()
    {
        const MapToGround map = map_to_ground();
        frame().body = map.body();
        const auto centre = scale_at(map, 0.5, 0.5);
        if (!centre)
            refuse(map.is_geographic() ? "its centre lies at a pole, where cells in degrees have no width; "
                                             + warp_remedy(file_, frame())
                                       : "its centre lies outside the projection of its coordinate system");
        frame().centre = centre->place;
        frame().body->local_radius_m = map.local_radius_m(centre->place.latitude);

        const CellSteps on_ground = cell_steps(gt(), centre->per_x, centre->per_y);
        require_cells(on_ground);
        const double sign = map.axis_sign();
        const CellSteps axes = {sum(centre->per_x, sign, {}, 0.0), sum(centre->per_y, -sign, {}, 0.0)};
        const double map_north = map.is_geographic() ? 0.0 : turn_deg(axes);
        frame().map_north = Angle::from_degrees(std::abs(map_north) < 1e-9 ? 0.0 : map_north);

        const double unit_m = map.metres_per_unit() * sign;
        const bool honest = !map.is_geographic() && is_true_to_scale(*centre, map.metres_per_unit());
        settle_cells(honest ? cell_steps(gt(), {unit_m, 0.0}, {0.0, unit_m}) : turned(on_ground, -map_north));
        if (cell_size_m_)
            return;
        if (!honest)
            note_measured_cells(map);
        check_edges(map, on_ground);
    }

    MapToGround map_to_ground() const
    {
        try {
            return MapToGround(*file_.crs);
        } catch (const InputError& error) {
            refuse(error.what());
        }
    }

    std::optional<MapScale> scale_at(const MapToGround& map, double down, double across) const
    {
        const double row = down * static_cast<double>(file_.rows);
        const double column = across * static_cast<double>(file_.columns);
        return map.at(gt()[0] + gt()[1] * column + gt()[2] * row, gt()[3] + gt()[4] * column + gt()[5] * row);
    }

    static bool is_true_to_scale(const MapScale& scale, double unit_m)
    {
        return std::abs(length_m(scale.per_x) / unit_m - 1.0) <= kStretchIgnored
               && std::abs(length_m(scale.per_y) / unit_m - 1.0) <= kStretchIgnored;
    }

    static CellSteps turned(const CellSteps& steps, double clockwise_deg)
    {
        const SineCosine turning = sine_cosine(Angle::from_degrees(clockwise_deg));
        const auto turn = [&](GroundVector v) {
            return GroundVector{v.east_m * turning.cosine + v.north_m * turning.sine,
                                v.north_m * turning.cosine - v.east_m * turning.sine};
        };
        return {turn(steps.column), turn(steps.row)};
    }

    void require_cells(const CellSteps& steps) const
    {
        const double x = length_m(steps.column);
        const double y = length_m(steps.row);
        if (!(x > 0.0 && std::isfinite(x) && y > 0.0 && std::isfinite(y)))
            refuse("its geotransform gives cells of " + plain_number(x, 6) + " x " + plain_number(y, 6)
                   + " m; they must be above 0");
        if (!(shear_deg(steps) <= kShearRefused_deg))
            refuse("its rows and columns are not at right angles (off by " + plain_number(shear_deg(steps), 1)
                   + " degrees): a sheared raster; " + warp_remedy(file_, result_.frame));
    }

    void settle_cells(const CellSteps& steps)
    {
        frame().cell_size_m = {length_m(steps.column), length_m(steps.row)};
        put_in_order(steps, frame());
        if (shear_deg(steps) > kShearIgnored_deg)
            warn("rows and columns are off the right angle by " + plain_number(shear_deg(steps), 1)
                 + " degrees; taken as right");
    }

    std::string cells_words()
    {
        return plain_number(frame().cell_size_m.x, 4) + " x " + plain_number(frame().cell_size_m.y, 4) + " m";
    }

    void note_measured_cells(const MapToGround& map)
    {
        const double x = std::hypot(gt()[1], gt()[4]);
        const double y = std::hypot(gt()[2], gt()[5]);
        const std::string unit =
            map.is_geographic() ? " degrees" : " map units, which the projection stretches,";
        const double to_words = map.is_geographic() ? degrees_per_unit() : 1.0;
        note("cells of " + plain_number(x * to_words, 8) + " x " + plain_number(y * to_words, 8) + unit
             + " measured as " + cells_words() + " at latitude " + latitude_words(frame().centre->latitude));
    }

    double degrees_per_unit() const { return degrees(file_.crs->GetAngularUnits()); }

    // Cells at the corners and the middles of the edges against those at the centre.
    void check_edges(const MapToGround& map, const CellSteps& centre)
    {
        double widest = 1.0;
        double narrowest = 1.0;
        bool complete = true;
        for (const double down : {0.0, 0.5, 1.0}) {
            for (const double across : {0.0, 0.5, 1.0}) {
                const auto scale = scale_at(map, down, across);
                if (!scale) {
                    complete = false;
                    continue;
                }
                const CellSteps steps = cell_steps(gt(), scale->per_x, scale->per_y);
                for (const double ratio : {length_m(steps.column) / length_m(centre.column),
                                           length_m(steps.row) / length_m(centre.row)}) {
                    widest = std::max(widest, ratio);
                    narrowest = std::min(narrowest, ratio);
                }
            }
        }
        judge_variation(map, widest / narrowest, complete);
    }

    void judge_variation(const MapToGround& map, double variation, bool complete)
    {
        const bool at_pole = map.is_geographic() && !complete;
        if (at_pole || !(variation <= kVariationRefused))
            refuse((at_pole ? std::string("reaches a pole, where cells in degrees have no width")
                            : "its cells differ in size on the ground by a factor of "
                                  + plain_number(variation, 1) + " from edge to edge, at most "
                                  + plain_number(kVariationRefused, 0) + " can be used")
                   + "; " + warp_remedy(file_, frame()));
        const double latitude = std::abs(frame().centre->latitude.degrees());
        if (variation > kVariationIgnored || (map.is_geographic() && latitude > kHighLatitude_deg))
            warn("cells differ in size by " + plain_number((variation - 1.0) * 100.0, 1)
                 + " % from edge to edge, and are all taken as at the centre; "
                 + warp_remedy(file_, frame()));
        if (!complete && !map.is_geographic())
            warn("parts of the raster lie outside the projection of its coordinate system");
    }

    const Georeference& file_;
    std::optional<double> cell_size_m_;
    SettledGround result_;
};

} // namespace

SettledGround settle_ground(const Georeference& file, std::optional<double> cell_size_m)
{
    return Settling(file, cell_size_m).run();
}

} // namespace duskline
