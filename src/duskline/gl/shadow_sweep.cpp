// Sets up the passes of the sweep; what they do is told in shaders/sweep_answers.comp.glsl. Source: as casting/sweep.cpp.

#include <duskline/casting/kernels/kernels.h>
#include <duskline/casting/light_frame.h>
#include <duskline/casting/shadow_mask.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/shadow_sweep.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace duskline::gl {

namespace {

// As the shaders have it: struct Shift.
struct Shift {
    GLint whole;
    GLfloat fraction;
};

// One of the lights that are cast together.
struct Limb {
    float drop_m = 0.0f;
    float lowest_m = -std::numeric_limits<float>::infinity();
    float highest_m = std::numeric_limits<float>::infinity();
};

// Steeper light than this shades nothing anyone could have measured; the CPU's sweep says the same.
constexpr double kSteepestDrop_m = 1.0e15;

ProgramDescription pass(const char* file, const ShadowSweepOptions& options)
{
    return {{file}, {{"DUSKLINE_LIMBS", options.limbs ? "2" : "1"}}};
}

DirectionalLight at_altitude(const DirectionalLight& light, double degrees)
{
    DirectionalLight moved = light;
    moved.altitude = Angle::from_degrees(std::clamp(degrees, -90.0, 90.0));
    return moved;
}

Limb limb_of(const DirectionalLight& light, CellSize cell_size_m)
{
    Limb limb;
    const auto uniform = uniform_answer(light);
    if (uniform == Lit::no)
        limb.lowest_m = std::numeric_limits<float>::infinity();
    else if (uniform == Lit::yes)
        limb.highest_m = -std::numeric_limits<float>::infinity();
    else
        limb.drop_m = static_cast<float>(std::min(light_frame(light, cell_size_m).drop_m, kSteepestDrop_m));
    return limb;
}

// The light's centre, or the upper and the lower edge of its disc.
std::array<Limb, 2> limbs_of(const DirectionalLight& light, CellSize cell_size_m, bool both)
{
    const double altitude = light.altitude.degrees();
    const double radius = both ? 0.5 * light.angular_diameter.degrees() : 0.0;
    const Limb upper = limb_of(at_altitude(light, altitude + radius), cell_size_m);
    // Of a disc that is partly up, what is above the horizontal counts: light along it falls by nothing.
    if (both && altitude - radius <= 0.0 && altitude + radius > 0.0)
        return {upper, Limb{}};
    return {upper, limb_of(at_altitude(light, altitude - radius), cell_size_m)};
}

std::vector<Shift> shifts_of(double lateral, std::size_t lines)
{
    std::vector<Shift> shifts;
    shifts.reserve(lines);
    for (std::size_t v = 0; v < lines; ++v) {
        const kernels::BeamShift shift = kernels::beam_shift(lateral, v);
        shifts.push_back({static_cast<GLint>(shift.whole), shift.fraction});
    }
    return shifts;
}

// What all passes are told.
struct Layout {
    LightFrame frame;
    std::size_t lines;
    std::size_t cells;
    std::size_t segments;
    std::size_t drift; ///< more than the cells that beams move sideways
    std::size_t beams;
    int first_beam;
};

Layout layout_of(const Texture& heights, const LightFrame& frame, std::size_t lines_per_segment)
{
    Layout layout{};
    layout.frame = frame;
    layout.lines = frame.lines_are_rows ? heights.height() : heights.width();
    layout.cells = frame.lines_are_rows ? heights.width() : heights.height();
    layout.segments = (layout.lines + lines_per_segment - 1) / lines_per_segment;
    layout.drift = static_cast<std::size_t>(kernels::beam_shift(frame.lateral, layout.lines - 1).whole) + 1;
    layout.beams = layout.cells + layout.drift + 2; // one more at either end
    layout.first_beam = frame.lateral < 0.0 ? -1 : -static_cast<int>(layout.drift);
    return layout;
}

void describe(const Program& program, const Layout& layout, std::size_t lines_per_segment)
{
    using Texels = std::array<int, 2>;
    const LightFrame& frame = layout.frame;
    const int direction = frame.first_line_is_index_0 ? 1 : -1;
    const int first = frame.first_line_is_index_0 ? 0 : static_cast<int>(layout.lines) - 1;
    program.set("lines", static_cast<int>(layout.lines));
    program.set("cells", static_cast<int>(layout.cells));
    program.set("first_texel", frame.lines_are_rows ? Texels{0, first} : Texels{first, 0});
    program.set("line_step", frame.lines_are_rows ? Texels{0, direction} : Texels{direction, 0});
    program.set("cell_step", frame.lines_are_rows ? Texels{1, 0} : Texels{0, 1});
    program.set("sideways", frame.lateral < 0.0 ? -1 : 1);
    program.set("halfway", frame.lateral != std::trunc(frame.lateral) ? 1 : 0);
    program.set("first_beam", layout.first_beam);
    program.set("beams", static_cast<int>(layout.beams));
    program.set("lines_per_segment", static_cast<int>(lines_per_segment));
}

void describe(const Program& program, const std::array<Limb, 2>& limbs, bool both)
{
    if (both)
        program.set("drop_m", std::array<float, 3>{limbs[0].drop_m, limbs[1].drop_m, 0.0f});
    else
        program.set("drop_m", limbs[0].drop_m);
    program.set("lowest_m", std::array<float, 2>{limbs[0].lowest_m, limbs[1].lowest_m});
    program.set("highest_m", std::array<float, 2>{limbs[0].highest_m, limbs[1].highest_m});
}

} // namespace

ShadowSweep::ShadowSweep(const ShaderSources& sources, const ShadowSweepOptions& options)
    : options_(options), segments_(sources, pass("sweep_segments.comp.glsl", options)),
      fronts_pass_(sources, pass("sweep_fronts.comp.glsl", options)),
      answers_(sources, pass("sweep_answers.comp.glsl", options))
{
    if (options.lines_per_segment == 0 || options.lines_per_segment % kernels::kLinesPerTilt != 0)
        throw InvalidInput("lines per segment must be a multiple of " + std::to_string(kernels::kLinesPerTilt)
                           + ", got " + std::to_string(options.lines_per_segment));
}

const Texture& ShadowSweep::cast(const Texture& heights, CellSize cell_size_m, const DirectionalLight& light)
{
    require_valid(HeightField{{}, cell_size_m});
    require_valid(light);
    const auto limbs = limbs_of(light, cell_size_m, options_.limbs);
    const Layout layout = layout_of(heights, light_frame(light, cell_size_m), options_.lines_per_segment);
    make_room(heights, layout.beams * (layout.segments + 1));
    shifts_.upload(shifts_of(layout.frame.lateral, layout.lines));

    heights.bind(0);
    shadow_heights_->bind_image(0, Texture::Access::write);
    shifts_.bind_as_storage(0);
    fronts_.bind_as_storage(1);
    for (const Program* program : {&segments_, &fronts_pass_, &answers_}) {
        describe(*program, layout, options_.lines_per_segment);
        describe(*program, limbs, options_.limbs);
    }

    dispatch(segments_, layout.beams, layout.segments - 1); // nothing comes after the last
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    dispatch(fronts_pass_, layout.beams);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    dispatch(answers_, layout.cells + std::min(layout.drift, options_.lines_per_segment), layout.segments);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    return *shadow_heights_;
}

void ShadowSweep::make_room(const Texture& heights, std::size_t fronts)
{
    const std::size_t width = heights.width();
    const std::size_t height = heights.height();
    if (!shadow_heights_ || shadow_heights_->width() != width || shadow_heights_->height() != height)
        shadow_heights_.emplace(options_.limbs ? TextureFormat::rg32f : TextureFormat::r32f, width, height);
    const std::size_t bytes = fronts * 2 * (options_.limbs ? 4 : 1) * sizeof(float);
    if (fronts_.bytes() < bytes)
        fronts_ = Buffer(bytes);
}

bool ShadowSweep::reload_if_changed(const ShaderSources& sources)
{
    const bool segments = segments_.reload_if_changed(sources);
    const bool fronts = fronts_pass_.reload_if_changed(sources);
    return answers_.reload_if_changed(sources) || segments || fronts;
}

} // namespace duskline::gl
