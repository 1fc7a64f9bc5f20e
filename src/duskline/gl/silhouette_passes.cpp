// Builds silhouette maps by drawing over textures: colours, then as many passes of FindNextV as it takes, from one
// texture to another and back, then the silhouettes that are covered. What a pass does is told in shaders/smap_*.glsl.
//
// Departs from its source (Sakalauskas 2008) as casting/smap_beams.cpp does; four lines of a beam in one texel follow the
// beam sideways, where the source does not say how.

#include <duskline/casting/smap_beams.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/read_back.h>
#include <duskline/gl/screen_pass.h>
#include <duskline/gl/silhouette_passes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace duskline::gl {

namespace {

// What shaders know of the lines: shift (whole, and exact as a float), part, tilt and rounding, a texel each.
Texture line_texture(const std::vector<SilhouetteLineFacts>& lines)
{
    Grid<std::array<float, 4>> facts(1, lines.size());
    std::ranges::transform(lines, facts.values().begin(), [](const SilhouetteLineFacts& line) {
        return std::array{static_cast<float>(line.shift), line.part, line.tilt_m, line.rounding_m};
    });
    Texture texture(TextureFormat::rgba32f, lines.size(), 1);
    texture.upload(facts);
    return texture;
}

// Two textures that are read and written in turn.
class TexelPair {
public:
    TexelPair(TextureFormat format, std::size_t width, std::size_t height)
        : textures_{Texture(format, width, height), Texture(format, width, height)},
          targets_{Framebuffer({&textures_[0]}), Framebuffer({&textures_[1]})}
    {}

    const Texture& newer() const { return textures_[newer_]; }
    const Framebuffer& target() const { return targets_[1 - newer_]; }
    void written() { newer_ = 1 - newer_; }

private:
    std::array<Texture, 2> textures_;
    std::array<Framebuffer, 2> targets_;
    std::size_t newer_ = 0;
};

// One that is written once.
struct Target {
    Texture texture;
    Framebuffer framebuffer;

    Target(TextureFormat format, std::size_t width, std::size_t height)
        : texture(format, width, height), framebuffer({&texture})
    {}
};

int lanes_of(const SilhouetteMapOptions& options)
{
    return options.search == NextVSearch::parallel_quad ? 4 : 1;
}

std::vector<ShaderDefine> defines_of(const SilhouetteMapOptions& options, bool full_scan = false)
{
    return {{"DUSKLINE_SMAP_LANES", std::to_string(lanes_of(options))},
            {"DUSKLINE_FULL_SCAN", full_scan ? "1" : "0"}};
}

} // namespace

struct SilhouettePasses::State {
    State(const ShaderSources& sources, const SilhouetteMapOptions& map_options)
        : options(map_options), colour(sources, screen_program("smap_colour.frag.glsl", defines_of(options))),
          bounds(sources, screen_program("smap_bounds.frag.glsl", defines_of(options))),
          next(sources, screen_program("smap_next.frag.glsl", defines_of(options))),
          covered(sources, screen_program("smap_covered.frag.glsl", defines_of(options))),
          look_up(sources, screen_program("smap_mask.frag.glsl", defines_of(options))),
          full_scan(sources, screen_program("smap_mask.frag.glsl", defines_of(options, true)))
    {}

    void describe(const Program& program) const;
    void run(const Program& program);
    const Texture& answered(const Program& program);

    SilhouetteMapOptions options;
    ScreenPass screen;
    Program colour;
    Program bounds;
    Program next;
    Program covered;
    Program look_up;
    Program full_scan;

    const Texture* heights = nullptr;
    std::optional<Lit> uniform;
    LightFrame frame;
    std::size_t line_count = 0;
    std::size_t cells = 0;
    int margin = 0; // columns before the first, for beams that enter within a texel
    std::vector<SilhouetteLineFacts> lines;
    std::optional<Texture> line_facts;
    std::optional<TexelPair> texels;
    std::optional<Target> bounds_target;
    std::optional<Target> mask;
};

SilhouettePasses::SilhouettePasses(const ShaderSources& sources, const SilhouetteMapOptions& options)
    : state_(std::make_unique<State>(sources, options))
{}

SilhouettePasses::SilhouettePasses(SilhouettePasses&&) noexcept = default;
SilhouettePasses& SilhouettePasses::operator=(SilhouettePasses&&) noexcept = default;
SilhouettePasses::~SilhouettePasses() = default;

void SilhouettePasses::State::describe(const Program& program) const
{
    using Texels = std::array<int, 2>;
    const int direction = frame.first_line_is_index_0 ? 1 : -1;
    const int first = frame.first_line_is_index_0 ? 0 : static_cast<int>(line_count) - 1;
    program.set("smap_line_count", static_cast<int>(line_count));
    program.set("smap_cells", static_cast<int>(cells));
    program.set("smap_first_texel", frame.lines_are_rows ? Texels{0, first} : Texels{first, 0});
    program.set("smap_line_step", frame.lines_are_rows ? Texels{0, direction} : Texels{direction, 0});
    program.set("smap_cell_step", frame.lines_are_rows ? Texels{1, 0} : Texels{0, 1});
    program.set("smap_margin", margin);
    program.set("smap_lateral", static_cast<float>(frame.lateral));
    program.set("smap_drop_m", static_cast<float>(frame.drop_m));
}

// From the newer texels into the older ones.
void SilhouettePasses::State::run(const Program& program)
{
    texels->newer().bind(1);
    screen.draw(program, texels->target());
    texels->written();
}

void SilhouettePasses::set_light(const Texture& heights, CellSize cell_size_m, const DirectionalLight& light,
                                 float greatest_m)
{
    require_valid(HeightField{{}, cell_size_m});
    require_valid(light);
    if (!(greatest_m >= 0.0f && std::isfinite(greatest_m)))
        throw InvalidInput("the greatest height must be finite and at least 0, got "
                           + std::to_string(greatest_m));
    State& s = *state_;
    s.heights = &heights;
    s.uniform = uniform_answer(light);
    if (s.uniform)
        return;
    s.frame = light_frame(light, cell_size_m);
    s.line_count = s.frame.lines_are_rows ? heights.height() : heights.width();
    s.cells = s.frame.lines_are_rows ? heights.width() : heights.height();
    s.lines = silhouette_lines(s.frame, s.line_count, greatest_m);
    s.line_facts = line_texture(s.lines);

    // Beams that enter on the second to fourth line of a texel were outside on the first.
    const auto lanes = static_cast<std::size_t>(lanes_of(s.options));
    s.margin = s.frame.lateral > 0.0 ? static_cast<int>(lanes) - 1 : 0;
}

void SilhouettePasses::build(const Texture& heights, CellSize cell_size_m, const DirectionalLight& light,
                             float greatest_m)
{
    set_light(heights, cell_size_m, light, greatest_m);
    State& s = *state_;
    if (s.uniform)
        return;
    const auto lanes = static_cast<std::size_t>(lanes_of(s.options));
    const std::size_t width = s.cells + 1 + (lanes - 1);
    const std::size_t height = (s.line_count + lanes - 1) / lanes;
    if (!s.texels || s.texels->newer().width() != width || s.texels->newer().height() != height) {
        s.texels.emplace(lanes == 4 ? TextureFormat::rgba32i : TextureFormat::r32i, width, height);
        s.bounds_target.reset();
    }
    if (s.options.better_next_v && (!s.bounds_target || s.bounds_target->texture.height() != s.line_count))
        s.bounds_target.emplace(TextureFormat::rgba32f, width, s.line_count);

    heights.bind(0);
    s.line_facts->bind(2);
    for (const Program* program : {&s.colour, &s.bounds, &s.next, &s.covered})
        s.describe(*program);
    const SilhouetteMargins margins = silhouette_margins(s.frame.drop_m, greatest_m);
    s.colour.set("rise_m", margins.rise_m);
    s.colour.set("fall_m", margins.fall_m);
    s.run(s.colour);
    if (s.options.better_next_v) {
        s.screen.draw(s.bounds, s.bounds_target->framebuffer);
        s.bounds_target->texture.bind(3);
    }
    const std::size_t blocks = s.options.search == NextVSearch::binary ? 2 : 4;
    s.next.set("blocks", static_cast<int>(blocks));
    s.next.set("better", s.options.better_next_v ? 1 : 0);
    for (std::size_t distance = 1; distance < s.line_count; distance *= blocks) {
        s.next.set("distance_lines", static_cast<int>(distance));
        s.run(s.next);
    }
    if (s.options.better_next_v)
        s.run(s.covered);
}

const Texture* SilhouettePasses::texels() const
{
    return state_->uniform || !state_->texels ? nullptr : &state_->texels->newer();
}

Grid<SilhouetteTexel> SilhouettePasses::read_texels() const
{
    if (texels() == nullptr)
        return {};
    const State& s = *state_;
    Grid<SilhouetteTexel> all(s.line_count, s.cells + 1);
    const auto fill = [&](const auto& packed, std::size_t lanes, auto&& lane_of) {
        for (std::size_t v = 0; v < s.line_count; ++v) {
            const int moved = s.lines[v - v % lanes].shift - s.lines[v].shift + s.margin;
            const auto row = packed.row(v / lanes).subspan(static_cast<std::size_t>(moved));
            for (std::size_t x = 0; x <= s.cells; ++x)
                all(v, x).bits = lane_of(row[x], v % lanes);
        }
    };
    if (lanes_of(s.options) == 4)
        fill(read_back<std::array<std::int32_t, 4>>(*texels()), 4,
             [](const auto& texel, std::size_t lane) { return texel[lane]; });
    else
        fill(read_back<std::int32_t>(*texels()), 1, [](std::int32_t texel, std::size_t) { return texel; });
    return all;
}

double SilhouettePasses::black_share() const
{
    const Grid<SilhouetteTexel> all = read_texels();
    const auto black = std::ranges::count_if(all.values(), &SilhouetteTexel::is_black);
    return all.empty() ? 0.0 : static_cast<double>(black) / static_cast<double>(all.size());
}

std::vector<ShaderDefine> SilhouettePasses::look_up_defines(int first_unit) const
{
    std::vector<ShaderDefine> defines = {{"DUSKLINE_SMAP_LANES", std::to_string(lanes_of(state_->options))}};
    for (const char* name : {"DUSKLINE_SMAP_HEIGHTS", "DUSKLINE_SMAP_TEXELS", "DUSKLINE_SMAP_LINES"})
        defines.push_back({name, std::to_string(first_unit++)});
    return defines;
}

void SilhouettePasses::bind(const Program& program, int first_unit) const
{
    const State& s = *state_;
    if (s.heights == nullptr)
        throw InvalidInput("a silhouette map must be built before it is looked up");
    const auto unit = static_cast<unsigned int>(first_unit);
    s.heights->bind(unit);
    if (s.texels)
        s.texels->newer().bind(unit + 1);
    if (s.line_facts)
        s.line_facts->bind(unit + 2);
    s.describe(program);
}

const Texture& SilhouettePasses::State::answered(const Program& program)
{
    if (!mask || mask->texture.width() != heights->width() || mask->texture.height() != heights->height()) {
        mask.emplace(TextureFormat::r8, heights->width(), heights->height());
        mask->texture.set_filter(Texture::Filter::linear);
    }
    if (uniform) {
        const float lit = *uniform == Lit::yes ? 1.0f : 0.0f;
        mask->framebuffer.clear({lit, lit, lit, lit});
    } else {
        screen.draw(program, mask->framebuffer);
    }
    return mask->texture;
}

const Texture& SilhouettePasses::mask()
{
    bind(state_->look_up);
    return state_->answered(state_->look_up);
}

const Texture& SilhouettePasses::mask_by_full_scan()
{
    bind(state_->full_scan);
    return state_->answered(state_->full_scan);
}

} // namespace duskline::gl
