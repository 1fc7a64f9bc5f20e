#include "gl/gl_test.h"
#include "gl/made_planet.h"

#include <duskline/geometry/cross_product.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/framebuffer.h>
#include <duskline/gl/read_back.h>
#include <duskline/planet/caster_space.h>
#include <duskline/planet/planet_sight.h>

#include <algorithm>
#include <cmath>

namespace duskline::gl {
namespace {

using namespace angle_literals;

constexpr std::uint32_t kLevel = 12; // squares of 19 m
constexpr float kNoGround = -9.0f;

// Hills up to 250 m high, some 2 km apart.
double hills_m(const Vector3& d)
{
    const double coarse = std::sin(2e4 * d.x + 1.0) * std::sin(2.1e4 * d.y) * std::sin(1.9e4 * d.z + 2.0);
    const double fine = std::sin(7.3e4 * d.x) * std::sin(6.7e4 * d.y + 0.5);
    return 400.0 + 200.0 * coarse + 40.0 * fine;
}

// A few tiles of a planet by night, with lamps over the one in the middle.
class Night {
public:
    explicit Night(const MadePlanet::Height& height)
        : planet_(kWgs84, height), renderer_(sources_, kWgs84, planet_.source()),
          places_(TextureFormat::rgba32f, 200, 150), colours_(TextureFormat::rgba8, 200, 150),
          depth_(TextureFormat::depth32f, 200, 150), probe_({&places_}, &depth_),
          picture_({&colours_}, &depth_)
    {
        constexpr double never = std::numeric_limits<double>::infinity();
        middle_ = place_in_tile(direction_at(kWgs84, {-155.47_deg, 19.82_deg}), kLevel).tile;
        for (const int row : {-1, 0, 1})
            for (const int column : {-1, 0, 1})
                patches_.push_back({{middle_.face, kLevel, middle_.row + static_cast<std::uint32_t>(row),
                                     middle_.column + static_cast<std::uint32_t>(column)},
                                    {never, never}});
        view_.eye_m = over(10.0, 64.0, 900.0);
        view_.axes = looking(kWgs84, view_.eye_m, 0.0, 0.0);
        view_.width = 200;
        view_.height = 150;
        light_.to_sun = normalized(over(0.0, 0.0, 0.0)) * -1.0;
        light_.lamps = &maps_;
        look_at(over(64.0, 64.0, 0.0));
    }

    // So far over a place of the tile in the middle.
    Vector3 over(double row, double column, double height_m) const
    {
        const Vector3 direction = sample_direction(middle_, row, column);
        return point_m(kWgs84, direction, planet_.ground_m(direction) + height_m);
    }

    void look_at(const Vector3& place_m)
    {
        const Vector3 forward = normalized(place_m - view_.eye_m);
        const Vector3 right = normalized(cross(forward, view_.eye_m));
        view_.axes = {forward, right, cross(right, forward)};
    }

    void light(const std::vector<SceneLamp>& lamps)
    {
        maps_.update(lamps, [&](const LampFace& face) {
            std::vector<PlanetPatch> casters = patches_;
            std::erase_if(casters, [&](const PlanetPatch& patch) {
                const OrientedBox box = box_around(kWgs84, patch.tile, planet_.heights_of(patch.tile).range);
                return !may_cast_into(face, box);
            });
            renderer_.draw_depth(view_.eye_m, face_to_clip(face, view_.eye_m), casters);
        });
    }

    Grid<std::array<float, 4>> probed(std::size_t lamp)
    {
        probe_.clear({0.0f, 0.0f, 0.0f, kNoGround});
        probe_.bind();
        renderer_.probe_lamp(view_, light_, patches_, lamp);
        return read_back<std::array<float, 4>>(places_);
    }

    Grid<std::array<std::uint8_t, 4>> picture()
    {
        picture_.clear();
        picture_.bind();
        renderer_.draw_ground(view_, light_, patches_);
        return read_back_picture(200, 150);
    }

    PlanetSight sight() { return PlanetSight({kWgs84, kLevel, {0.0f, 700.0f}, planet_.source()}); }

    PlanetLight& planet_light() { return light_; }
    const PlanetView& view() const { return view_; }
    void forget_lamps() { light_.lamps = nullptr; }

private:
    ShaderSources sources_;
    MadePlanet planet_;
    PlanetRenderer renderer_;
    LampMaps maps_;
    PlanetTile middle_;
    std::vector<PlanetPatch> patches_;
    PlanetView view_;
    PlanetLight light_;
    Texture places_;
    Texture colours_;
    Texture depth_;
    Framebuffer probe_;
    Framebuffer picture_;
};

Vector3 as_vector(const std::array<float, 4>& pixel)
{
    return {static_cast<double>(pixel[0]), static_cast<double>(pixel[1]), static_cast<double>(pixel[2])};
}

// Whether truth is the same all round a place, so far aside as seen from the lamp.
bool is_far_from_edges(const PlanetSight& sight, const Vector3& lamp_m, const Vector3& place_m,
                       double radians)
{
    const Vector3 ray = place_m - lamp_m;
    const bool lit = sight.sees(lamp_m, place_m);
    const Vector3 right = normalized(cross(ray, {0.3, 0.5, 0.8}));
    const Vector3 up = normalized(cross(ray, right));
    for (const double share : {0.33, 0.67, 1.0})
        for (int i = 0; i < 12; ++i) {
            const auto [sine, cosine] = sine_cosine(Angle::from_degrees(30.0 * i));
            const Vector3 aside = (right * sine + up * cosine) * (share * radians * length(ray));
            if (sight.sees(lamp_m, place_m + aside) != lit)
                return false;
        }
    return true;
}

using PlanetLamps = GlTest;

TEST_F(PlanetLamps, ShowWhatASightlineSeesButForTwoTexelsAtEdges)
{
    Night night(hills_m);
    const PlanetSight sight = night.sight();
    const std::vector<SceneLamp> lamps = {
        {.position_m = night.over(64.3, 60.2, 40.0), .range_m = 4000.0},
        {.position_m = night.over(90.0, 30.0, 150.0),
         .direction = night.over(60.0, 70.0, 0.0) - night.over(90.0, 30.0, 150.0),
         .half_angle = 35_deg}};
    night.light(lamps);
    for (std::size_t lamp = 0; lamp < lamps.size(); ++lamp) {
        const Grid<std::array<float, 4>> pixels = night.probed(lamp);
        std::size_t lit = 0;
        std::size_t dark = 0;
        std::size_t beside = 0;
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < pixels.size(); i += 3) {
            const std::array<float, 4>& pixel = pixels.values()[i];
            if (pixel[3] < 0.0f)
                continue;
            const Vector3 place_m = night.view().eye_m + as_vector(pixel);
            const bool truth = sight.sees(lamps[lamp].position_m, place_m);
            (truth ? lit : dark) += 1;
            if ((pixel[3] >= 0.5f) == truth)
                continue;
            ++beside;
            wrong += is_far_from_edges(sight, lamps[lamp].position_m, place_m, 2.0 * 2.0 / 1016.0) ? 1U : 0U;
        }
        EXPECT_GT(lit, 1000U) << lamp;
        EXPECT_GT(dark, 500U) << lamp;
        EXPECT_LE(wrong, (lit + dark) / 500) << lamp << ": " << beside << " beside edges";
        EXPECT_LE(beside, (lit + dark) / 20) << lamp;
    }
}

TEST_F(PlanetLamps, LightAPlainAllRoundWithoutHoles)
{
    Night night([](const Vector3&) { return 100.0; });
    night.light({{.position_m = night.over(64.0, 64.0, 3.0), .bright_m = 100.0, .range_m = 900.0}});
    const Grid<std::array<float, 4>> pixels = night.probed(0);
    std::size_t lit = 0;
    for (const std::array<float, 4>& pixel : pixels.values())
        if (pixel[3] >= 0.0f) {
            ++lit;
            EXPECT_EQ(pixel[3], 1.0f);
        }
    EXPECT_GT(lit, 5000U);
}

TEST_F(PlanetLamps, BrightenTheNightAndAddUpWithTheSun)
{
    Night night(hills_m);
    const std::vector<SceneLamp> one = {
        {.position_m = night.over(64.3, 60.2, 40.0), .colour = {1.0f, 0.3f, 0.1f}, .bright_m = 600.0}};
    const auto sum = [](const Grid<std::array<std::uint8_t, 4>>& picture, std::size_t part) {
        std::size_t all = 0;
        for (const auto& pixel : picture.values())
            all += pixel.at(part);
        return all / picture.size();
    };
    night.light({});
    const auto dark = night.picture();
    night.light(one);
    const auto lit = night.picture();
    EXPECT_GT(sum(lit, 0), sum(dark, 0) + 40);
    EXPECT_GT(sum(lit, 0), sum(lit, 2) + 20); // reddish
    night.planet_light().to_sun = normalized(night.view().eye_m);
    const auto day = night.picture();
    night.light({});
    const auto sun_alone = night.picture();
    for (std::size_t i = 0; i < day.size(); ++i) {
        ASSERT_GE(day.values()[i][0], sun_alone.values()[i][0]);
        ASSERT_GE(lit.values()[i][0], dark.values()[i][0]);
    }
    EXPECT_GT(sum(day, 0), sum(sun_alone, 0));
}

TEST_F(PlanetLamps, AreNotToBeAskedForWhenTheyAreNotThere)
{
    Night night(hills_m);
    night.light({{.position_m = night.over(64.0, 64.0, 40.0)}});
    EXPECT_THROW(night.probed(1), InvalidInput);
    night.forget_lamps();
    EXPECT_THROW(night.probed(0), InvalidInput);
}

} // namespace
} // namespace duskline::gl
