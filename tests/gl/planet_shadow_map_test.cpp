// The shadow map on a planet, against rays over the level that is drawn.

#include "gl/edge_distance.h"
#include "gl/gl_test.h"
#include "gl/made_planet.h"

#include <duskline/gl/framebuffer.h>
#include <duskline/gl/read_back.h>
#include <duskline/planet/planet_ray.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace duskline::gl {
namespace {

using namespace angle_literals;

constexpr std::size_t kWidth = 96;
constexpr std::size_t kHeight = 72;
constexpr float kNoGround = -2.0f;
constexpr HeightRange kHeights = {-120.0f, 120.0f}; // of all ground
const Globe kBall = sphere_of_radius(50000.0);
const Vector3 kHere = normalized({0.8, 0.5, 0.4});

// All of a level that lies so near, turning into nothing.
void add_near(MadePlanet& planet, const PlanetTile& tile, std::uint32_t level, double reach_m,
              std::vector<PlanetPatch>& patches)
{
    constexpr double never = std::numeric_limits<double>::infinity();
    const Vector3 here_m = point_m(planet.globe(), kHere, 0.0);
    if (distance_m(here_m, box_around(planet.globe(), tile, kHeights)) > reach_m)
        return;
    if (tile.level == level)
        patches.push_back({tile, {never, never}});
    else
        for (const PlanetTile& child : children_of(tile))
            add_near(planet, child, level, reach_m, patches);
}

// A planet of one level around one place, under a sun, and its shadow map.
class Scene {
public:
    Scene(MadePlanet::Height height, std::uint32_t level, double reach_m,
          const ShadowMapOptions& options = {.size = 512})
        : planet_(kBall, std::move(height)), level_(level), renderer_(sources_, kBall, planet_.source()),
          map_(sources_, options), places_(TextureFormat::rgba32f, kWidth, kHeight),
          depth_(TextureFormat::depth32f, kWidth, kHeight), framebuffer_({&places_}, &depth_)
    {
        for (std::uint32_t face = 0; face < kCubeFaces; ++face)
            add_near(planet_, {face, 0, 0, 0}, level, reach_m, patches_);
    }

    // From so far over the ground, looking a little down.
    void look(double clearance_m, double heading_deg)
    {
        clearance_m_ = clearance_m;
        eye_m_ = point_m(kBall, kHere, ground_m(kHere) + clearance_m);
        axes_ = looking(kBall, eye_m_, heading_deg, -15.0);
    }

    void shine(double azimuth_deg, double altitude_deg)
    {
        const LocalFrame here = local_frame(kBall, kHere);
        const auto [east, north] = sine_cosine(Angle::from_degrees(azimuth_deg));
        const auto [up, along] = sine_cosine(Angle::from_degrees(altitude_deg));
        light_.to_sun = (here.east * east + here.north * north) * along + here.up * up;
    }

    // Of each pixel: the place from the eye, and how much light gets there by the map.
    Grid<std::array<float, 4>> probe()
    {
        map_.update(view(), [&](const ShadowBox& box) {
            renderer_.draw_depth(eye_m_, box_to_clip(box, eye_m_), patches_);
        });
        framebuffer_.bind();
        framebuffer_.clear({kNoGround, kNoGround, kNoGround, kNoGround});
        const PlanetView picture = {
            .eye_m = eye_m_, .axes = axes_, .vertical_view = 60_deg, .width = kWidth, .height = kHeight};
        PlanetShadow shadow;
        shadow.map = &map_;
        renderer_.probe_ground(picture, light_, patches_, shadow);
        return read_back<std::array<float, 4>>(places_);
    }

    // Whether the map has something to say of a place, and all of it.
    bool holds(const Vector3& from_eye_m) const
    {
        const ShadowBox& box = map_.box();
        const Vector3 from_centre_m = eye_m_ + from_eye_m - box.centre_m;
        return length(from_eye_m) < 0.9 * box.radius_m
               && std::max({std::abs(dot(from_centre_m, box.axes.right)),
                            std::abs(dot(from_centre_m, box.axes.up)),
                            std::abs(dot(from_centre_m, box.axes.towards_light))})
                      < 0.49 * box.side_m;
    }

    // On the triangles that are drawn.
    double ground_m(const Vector3& direction)
    {
        const TilePlace place = place_in_tile(direction, level_);
        const TileHeights& heights = planet_.heights_of(place.tile);
        const auto low = [](double at) {
            return static_cast<std::size_t>(std::clamp(at, 0.0, kTileSquares - 1.0));
        };
        const std::size_t row = low(place.row);
        const std::size_t column = low(place.column);
        const auto height_m = [&](std::size_t i, std::size_t j) {
            return static_cast<double>(heights.heights_m(row + i + 1, column + j + 1));
        };
        const double y = place.row - static_cast<double>(row);
        const double x = place.column - static_cast<double>(column);
        const double corner_m = y > x ? height_m(1, 0) : height_m(0, 1);
        return height_m(0, 0) + std::max(x, y) * (corner_m - height_m(0, 0))
               + std::min(x, y) * (height_m(1, 1) - corner_m);
    }

    PlanetRays rays()
    {
        return {{kBall, level_, kHeights,
                 [this](const PlanetTile& tile) -> const TileHeights& { return planet_.heights_of(tile); }},
                light_.to_sun};
    }

    const Vector3& eye_m() const { return eye_m_; }
    const ShadowBox& box() const { return map_.box(); }

private:
    ShadowView view() const
    {
        return {.eye_m = eye_m_,
                .forward = axes_.forward,
                .up = normalized(eye_m_),
                .half_view = 45_deg,
                .clearance_m = clearance_m_,
                .highest_above_eye_m =
                    static_cast<double>(kHeights.highest_m) + kBall.equatorial_radius_m - length(eye_m_),
                .curvature_per_m = 1.0 / kBall.equatorial_radius_m,
                .towards_light = light_.to_sun};
    }

    MadePlanet planet_;
    std::uint32_t level_;
    std::vector<PlanetPatch> patches_;
    ShaderSources sources_;
    PlanetRenderer renderer_;
    ShadowMap map_;
    Texture places_;
    Texture depth_;
    Framebuffer framebuffer_;
    PlanetLight light_;
    double clearance_m_ = 0.0;
    Vector3 eye_m_;
    CameraAxes axes_;
};

struct Found {
    std::size_t pixels = 0;
    std::size_t beside = 0; ///< that are not on the ground: slivers of seams, seen along them
    std::size_t dark = 0;
    std::size_t wrong = 0;
    std::size_t far = 0; ///< of those, with no edge of the truth within two texels
};

Found compare(Scene& scene)
{
    const auto pixels = scene.probe();
    const PlanetRays rays = scene.rays();
    const LocalFrame here = local_frame(kBall, kHere);
    Found found;
    for (const auto& pixel : pixels.values()) {
        const Vector3 from_eye_m = {static_cast<double>(pixel[0]), static_cast<double>(pixel[1]),
                                    static_cast<double>(pixel[2])};
        if (pixel[3] < 0.0f || !scene.holds(from_eye_m)) // no ground, or ground that faces away
            continue;
        const Vector3 place_m = scene.eye_m() + from_eye_m;
        const auto around = [&](double x_m, double y_m, double above_m) {
            const Vector3 direction = normalized(place_m + here.east * x_m + here.north * y_m);
            const double height_m = scene.ground_m(direction) + above_m;
            return GroundPlace{point_m(kBall, direction, height_m), rays.is_lit(direction, height_m)};
        };
        const GroundPlace truth = around(0.0, 0.0, 0.0);
        if (length(truth.position_m - place_m) > 0.1 * scene.box().texel_m) {
            ++found.beside;
            continue;
        }
        ++found.pixels;
        found.dark += truth.lit ? 0U : 1U;
        if (truth.lit == (pixel[3] > 0.5f))
            continue;
        ++found.wrong;
        found.far += has_edge_within(2.0, around, scene.box()) ? 0U : 1U;
    }
    return found;
}

// 1 km and 200 m from crest to crest.
double hills_m(const Vector3& d)
{
    const double coarse = std::sin(300.0 * d.x + 1.0) * std::sin(310.0 * d.y) + std::sin(290.0 * d.z + 2.0);
    const double fine = std::sin(1590.0 * d.x) * std::sin(1410.0 * d.y + 0.5) + std::sin(1500.0 * d.z);
    return 50.0 * coarse + 10.0 * fine;
}

using PlanetShadowMap = GlTest;

TEST_F(PlanetShadowMap, IsRightButForTwoTexelsAtEdgesFromEveryHeight)
{
    std::size_t dark = 0;
    for (const auto& [clearance_m, level] : {std::pair{15.0, 8U}, {50.0, 7U}, {100.0, 7U}, {200.0, 6U}}) {
        Scene scene(hills_m, level, 15.0 * clearance_m + 300.0);
        for (const auto& [azimuth_deg, altitude_deg] : {std::pair{75.0, 4.0}, {200.0, 10.0}, {20.0, 25.0}}) {
            scene.shine(azimuth_deg, altitude_deg);
            scene.look(clearance_m, azimuth_deg + 40.0);
            const Found found = compare(scene);
            EXPECT_EQ(found.far, 0U) << clearance_m << " m, " << altitude_deg << " degrees: " << found.wrong
                                     << " wrong of " << found.pixels;
            EXPECT_GT(found.pixels, 800U);
            EXPECT_LE(found.beside, 2U);
            dark += found.dark;
        }
    }
    EXPECT_GT(dark, 5000U);
}

TEST_F(PlanetShadowMap, CurvedAndTiltedGroundDoesNotShadeItself)
{
    const LocalFrame here = local_frame(kBall, kHere);
    const auto tilted = [&](double east, double north) {
        return [=, &here](const Vector3& d) {
            return kBall.equatorial_radius_m * (east * dot(d, here.east) + north * dot(d, here.north));
        };
    };
    for (const auto& [east, north] : {std::pair{0.0, 0.0}, {0.2, -0.1}})
        for (const ShadowMapFilter filter :
             {ShadowMapFilter::kernels, ShadowMapFilter::none, ShadowMapFilter::disc}) {
            Scene scene(tilted(east, north), 7, 300.0, {.size = 512, .filter = filter});
            for (const double altitude_deg : {2.0, 5.0, 15.0, 40.0, 80.0})
                for (const double azimuth_deg : {20.0, 160.0, 290.0}) {
                    scene.shine(azimuth_deg, altitude_deg);
                    const auto [sine, cosine] = sine_cosine(Angle::from_degrees(azimuth_deg));
                    const double rise = east * sine + north * cosine;
                    if (tangent(Angle::from_degrees(altitude_deg)) < rise + 0.035)
                        continue; // from behind, or along it
                    scene.look(15.0, azimuth_deg + 70.0);
                    std::size_t lit = 0;
                    const auto pixels = scene.probe();
                    for (const auto& pixel : pixels.values()) {
                        if (pixel[3] == kNoGround)
                            continue;
                        ASSERT_EQ(pixel[3], 1.0f) << altitude_deg << ", " << azimuth_deg;
                        ++lit;
                    }
                    EXPECT_GT(lit, kWidth * kHeight / 2);
                }
        }
}

} // namespace
} // namespace duskline::gl
