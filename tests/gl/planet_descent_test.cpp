#include "gl/gl_test.h"
#include "planet/hilly_planet.h"

#include <duskline/gl/framebuffer.h>
#include <duskline/gl/planet_renderer.h>
#include <duskline/gl/read_back.h>
#include <duskline/planet/caster_space.h>
#include <duskline/planet/planet_flight.h>
#include <duskline/planet/planet_quadtree.h>
#include <duskline/planet/planet_shadows.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace duskline::gl {
namespace {

using namespace angle_literals;

constexpr std::size_t kWidth = 160;
constexpr std::size_t kHeight = 120;
constexpr float kNoGround = -2.0f;

// A frame on the way down: where the ground of each pixel is from the eye, and how much light gets there.
struct Frame {
    PlanetCamera camera;
    CameraAxes axes;
    Grid<std::array<float, 4>> pixels;

    bool has_ground(std::size_t row, std::size_t column) const { return pixels(row, column)[3] != kNoGround; }
    float light(std::size_t row, std::size_t column) const { return std::max(0.0f, pixels(row, column)[3]); }
    Vector3 from_eye_m(std::size_t row, std::size_t column) const
    {
        const auto& pixel = pixels(row, column);
        return {static_cast<double>(pixel[0]), static_cast<double>(pixel[1]), static_cast<double>(pixel[2])};
    }
};

// How much of the ground that two frames show was lit in one and dark in the other.
struct Change {
    std::size_t pixels = 0;
    std::size_t dark = 0;
    std::size_t changed = 0;
    std::size_t changed_apart = 0; // with no edge within two pixels, in either frame
};

bool beside_edge(const Frame& frame, std::size_t row, std::size_t column)
{
    const auto is_lit = [&](std::size_t r, std::size_t c) { return frame.light(r, c) >= 0.5f; };
    for (std::size_t r = row - std::min<std::size_t>(row, 2); r <= std::min(row + 2, kHeight - 1); ++r)
        for (std::size_t c = column - std::min<std::size_t>(column, 2); c <= std::min(column + 2, kWidth - 1);
             ++c)
            if (frame.has_ground(r, c) && is_lit(r, c) != is_lit(row, column))
                return true;
    return false;
}

// Pixels of which the other frame shows the same ground.
void add_change(const Frame& a, const Frame& b, Change& change)
{
    const double per_radian =
        0.5 * kHeight / tangent(Angle::from_degrees(b.camera.vertical_view.degrees() / 2.0));
    for (std::size_t row = 0; row < kHeight; ++row)
        for (std::size_t column = 0; column < kWidth; ++column) {
            if (!a.has_ground(row, column))
                continue;
            const Vector3 place = a.camera.eye_m + a.from_eye_m(row, column);
            const Vector3 seen = place - b.camera.eye_m;
            const double ahead = dot(seen, b.axes.forward);
            const double x = 0.5 * kWidth + per_radian * dot(seen, b.axes.right) / ahead;
            const double y = 0.5 * kHeight + per_radian * dot(seen, b.axes.up) / ahead;
            if (!(ahead > 0.0 && x >= 0.0 && y >= 0.0 && x < kWidth && y < kHeight))
                continue;
            const auto r = static_cast<std::size_t>(y);
            const auto c = static_cast<std::size_t>(x);
            if (!b.has_ground(r, c) || length(b.from_eye_m(r, c) - seen) > 3.0 * ahead / per_radian)
                continue;
            ++change.pixels;
            change.dark += a.light(row, column) < 0.5f ? 1U : 0U;
            if (std::abs(a.light(row, column) - b.light(r, c)) <= 0.5f)
                continue;
            ++change.changed;
            change.changed_apart += beside_edge(a, row, column) || beside_edge(b, r, c) ? 0U : 1U;
        }
}

// What a map that is drawn anew changes while the eye stays: of the ground that faces the sun.
struct Redrawn {
    bool grown = false;   // or shrunk
    double changed = 0.0; // share of places whose light changes by more than a quarter
    double mean = 0.0;    // change of light
};

Redrawn change_between(const Frame& before, const Frame& after)
{
    Redrawn change;
    double places = 0.0;
    for (std::size_t i = 0; i < before.pixels.size(); ++i) {
        const float first = before.pixels.values()[i][3];
        const float second = after.pixels.values()[i][3];
        if (first < 0.0f || second < 0.0f)
            continue;
        const double difference = std::abs(static_cast<double>(first) - static_cast<double>(second));
        places += 1.0;
        change.changed += difference > 0.25 ? 1.0 : 0.0;
        change.mean += difference;
    }
    EXPECT_GT(places, 10000.0);
    change.changed /= places;
    change.mean /= places;
    return change;
}

// With mountains 500 m high and 1 to 5 km apart, which throw shadows on each other.
PlanetTerrain steep_planet()
{
    constexpr double cell_deg = 0.25;
    constexpr std::size_t rows = 720;
    PlanetSource source = {Grid<float>(rows, 2 * rows), Angle::from_degrees(-180.0), 90_deg,
                           Angle::from_degrees(cell_deg), Angle::from_degrees(cell_deg)};
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < 2 * rows; ++column) {
            const double y = static_cast<double>(row);
            const double x = static_cast<double>(column);
            source.heights_m(row, column) = static_cast<float>(100.0 * std::sin(0.9 * x) * std::cos(0.7 * y)
                                                               + 150.0 * std::sin(0.21 * x + 0.3 * y));
        }
    std::vector<PlanetSource> sources;
    sources.push_back(std::move(source));
    return PlanetTerrain(sphere_of_radius(50000.0), std::move(sources),
                         {.sea = false, .finest_spacing_m = 25.0});
}

// The sun over small_planet, low, and over steep_planet.
Vector3 low_sun(const Globe& globe)
{
    const LocalFrame here = local_frame(globe, direction_of_degrees(globe, 24.0, 14.0));
    return normalized(here.east * 0.9 + here.north * 0.4 + here.up * 0.02);
}
Vector3 morning_sun(const Globe& globe)
{
    const LocalFrame here = local_frame(globe, direction_of_degrees(globe, 20.0, 10.0));
    return normalized(here.east * 0.9 + here.north * 0.4 + here.up * 0.3);
}

// A flight down over a small planet.
class Flight {
public:
    Flight() : Flight(small_planet(), low_sun) {}
    Flight(PlanetTerrain terrain, Vector3 (*sun)(const Globe&))
        : terrain_(std::move(terrain)), sun_(sun(terrain_.globe())), quadtree_(terrain_),
          renderer_(
              sources_, terrain_.globe(),
              [this](const PlanetTile& tile) -> const TileHeights& { return quadtree_.heights_of(tile); }),
          fronts_(terrain_.globe(), sun_), places_(TextureFormat::rgba32f, kWidth, kHeight),
          depth_(TextureFormat::depth32f, kWidth, kHeight), framebuffer_({&places_}, &depth_)
    {
        light_.to_sun = sun_;
        follow_tiles();
    }

    Frame at(double share, bool by_map)
    {
        Frame frame = fly_to(share);
        show(frame, by_map ? map_for(frame) : fronts());
        return frame;
    }

    // What drawing the map anew changes there; nothing where it need not be.
    std::optional<Redrawn> redrawn_at(double share)
    {
        Frame before = fly_to(share);
        Frame after = {before.camera, before.axes, {}};
        if (!map_)
            map_for(before);
        const double side_m = map_->box().side_m;
        const std::size_t drawn = maps_drawn_;
        show(before, by_the_map());
        show(after, map_for(after));
        if (drawn == maps_drawn_)
            return std::nullopt;
        Redrawn change = change_between(before, after);
        change.grown = map_->box().side_m != side_m;
        return change;
    }

    // And what one of other texels would.
    Redrawn changed_by_size(double share, std::size_t size)
    {
        Frame usual = at(share, true);
        Frame other = {usual.camera, usual.axes, {}};
        map_.emplace(sources_, ShadowMapOptions{.size = size});
        show(other, map_for(other));
        map_.reset();
        return change_between(usual, other);
    }

    // The eye, and its tiles.
    Frame fly_to(double share)
    {
        const FlyDown flight = {
            .place = {20_deg, 10_deg}, .from_m = 60000.0, .to_m = 150.0, .last_pitch = -25_deg};
        Frame frame;
        frame.camera = fly_down(terrain_, flight, share);
        frame.axes = axes_of(terrain_.globe(), frame.camera);
        do {
            quadtree_.update(frame.camera, kWidth, kHeight, 1000);
            follow_tiles();
        } while (!quadtree_.settled());
        return frame;
    }

    void show(Frame& frame, const PlanetShadow& shadow)
    {
        framebuffer_.bind();
        framebuffer_.clear({kNoGround, kNoGround, kNoGround, kNoGround});
        const PlanetView view = {
            .eye_m = frame.camera.eye_m, .axes = frame.axes, .width = kWidth, .height = kHeight};
        renderer_.probe_ground(view, light_, quadtree_.patches(), shadow);
        frame.pixels = read_back<std::array<float, 4>>(places_);
    }

    // Of frames one beside the other, over part of the way.
    Change change_over(double first, double last, std::size_t frames, bool by_map)
    {
        Change change;
        std::optional<Frame> before;
        for (std::size_t i = 0; i < frames; ++i) {
            const double share = static_cast<double>(i) / static_cast<double>(frames - 1);
            Frame now = at(first + (last - first) * share, by_map);
            if (before)
                add_change(*before, now, change);
            before = std::move(now);
        }
        return change;
    }

    std::size_t maps_drawn() const { return maps_drawn_; }

private:
    void follow_tiles()
    {
        for (const TileCache::Change& change : quadtree_.changes())
            if (change.came)
                fronts_.insert(change.tile, quadtree_.shared_heights_of(change.tile));
            else
                fronts_.erase(change.tile);
    }

    PlanetShadow fronts()
    {
        fronts_.settle();
        return {[this](const PlanetTile& tile) { return fronts_.shown(tile); }};
    }

    PlanetShadow map_for(const Frame& frame)
    {
        if (!map_)
            map_.emplace(sources_, ShadowMapOptions{.size = 512});
        const Globe& globe = terrain_.globe();
        const Vector3& eye_m = frame.camera.eye_m;
        const ShadowView view = {.eye_m = eye_m,
                                 .forward = frame.axes.forward,
                                 .up = local_frame(globe, normalized(eye_m)).up,
                                 .half_view = 30_deg,
                                 .clearance_m = clearance_m(frame.camera, terrain_),
                                 .highest_above_eye_m = static_cast<double>(terrain_.heights().highest_m)
                                                        - height_m(globe, eye_m),
                                 .curvature_per_m = 1.0 / globe.equatorial_radius_m,
                                 .towards_light = light_.to_sun};
        maps_drawn_ += map_->update(view, [&](const ShadowBox& box) {
            renderer_.draw_depth(eye_m, box_to_clip(box, eye_m), casters_of(quadtree_, box));
        });
        return by_the_map();
    }

    // As it was drawn last.
    PlanetShadow by_the_map() const
    {
        PlanetShadow shadow;
        shadow.map = &*map_;
        return shadow;
    }

    PlanetTerrain terrain_;
    Vector3 sun_;
    PlanetQuadtree quadtree_;
    ShaderSources sources_;
    PlanetRenderer renderer_;
    PlanetShadows fronts_;
    std::optional<ShadowMap> map_;
    std::size_t maps_drawn_ = 0;
    PlanetLight light_;
    Texture places_;
    Texture depth_;
    Framebuffer framebuffer_;
};

using PlanetDescent = GlTest;

TEST_F(PlanetDescent, ChangesShadowsOfFrontsBesideTheirEdgesOnly)
{
    Flight flight;
    for (const double first : {0.2, 0.4, 0.6, 0.8}) {
        const Change change = flight.change_over(first, first + 0.04, 7, false);
        EXPECT_GT(change.pixels, 50000U) << first;
        EXPECT_GT(change.dark, change.pixels / 50) << first << ": " << change.dark << " of " << change.pixels;
        EXPECT_LT(static_cast<double>(change.changed_apart), 2e-4 * static_cast<double>(change.pixels))
            << first << ": " << change.changed << ", of these apart " << change.changed_apart;
    }
}

TEST_F(PlanetDescent, ChangesFewShadowsOfAMapWhenItsBoxChanges)
{
    Flight flight;
    for (const double first : {0.4, 0.6, 0.8}) {
        const std::size_t drawn = flight.maps_drawn();
        const Change change = flight.change_over(first, first + 0.04, 7, true);
        EXPECT_GT(flight.maps_drawn(), drawn + 1) << first;
        EXPECT_GT(change.pixels, 50000U) << first;
        EXPECT_LT(static_cast<double>(change.changed_apart), 5e-3 * static_cast<double>(change.pixels))
            << first << ": " << change.changed << ", of these apart " << change.changed_apart;
    }
}

// The eye stays while the map is drawn anew: what changes is the map's doing.
TEST_F(PlanetDescent, DoesNotShowThatTheMapIsDrawnAnew)
{
    Flight flight(steep_planet(), morning_sun);
    std::size_t moved = 0;
    std::size_t sized = 0;
    for (int i = 0; i < 72; ++i) {
        const double share = 0.58 + 0.005 * i;
        const auto change = flight.redrawn_at(share);
        if (!change)
            continue;
        (change->grown ? sized : moved) += 1;
        EXPECT_LT(change->changed, change->grown ? 8e-3 : 2e-3) << share;
        EXPECT_LT(change->mean, change->grown ? 1.6e-2 : 4e-3) << share;
    }
    EXPECT_GT(moved, 20U);
    EXPECT_GT(sized, 8U);
}

TEST_F(PlanetDescent, WouldShowMapsWhoseTexelsJump)
{
    for (const double share : {0.66, 0.72}) {
        Flight flight(steep_planet(), morning_sun);
        const Redrawn change = flight.changed_by_size(share, 320);
        EXPECT_GT(change.changed, 1.2e-2) << share;
        EXPECT_GT(change.mean, 2e-2) << share;
    }
}

} // namespace
} // namespace duskline::gl
