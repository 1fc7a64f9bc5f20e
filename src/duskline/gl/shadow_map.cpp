#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/framebuffer.h>
#include <duskline/gl/program.h>
#include <duskline/gl/saved_drawing.h>
#include <duskline/gl/screen_pass.h>
#include <duskline/gl/shadow_map.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>

namespace duskline::gl {

namespace {

// Shares of the radius up to which kernels are of 5, 4, 3 and 2 taps a side: 8, 16, 32 and 64 m of 72.
constexpr std::array<double, 4> kBorders = {1.0 / 9.0, 2.0 / 9.0, 4.0 / 9.0, 8.0 / 9.0};
constexpr double kFadeBegins = 0.9;

constexpr double kWidestSpread = 3.0; // under an overcast sky
constexpr double kFaintestShadow = 0.1;

// In depth units of the map, against roundings of surfaces that face the light.
constexpr float kConstantOffset = 1.0f;

// Enough for level ground in light of 1.8 degrees.
constexpr float kMostOffsetTexels = 64.0f;

BlockVec4 as_block(const std::array<float, 4>& v)
{
    return {v[0], v[1], v[2], v[3]};
}

void require_valid(const ShadowMapOptions& options)
{
    if (options.samples < 4 || options.samples > 16)
        throw InvalidInput("the disc of a shadow map has 4 to 16 samples, got "
                           + std::to_string(options.samples));
    if (!(options.spread > 0.0) || !(options.slope_offset >= 0.0))
        throw InvalidInput("the spread of a shadow map must be above 0 and its slope offset 0 or more, got "
                           + std::to_string(options.spread) + " and " + std::to_string(options.slope_offset));
    if (!(options.fade_from_m < options.fade_to_m))
        throw InvalidInput("shadows must fade from a lower clearance to a higher one, got "
                           + std::to_string(options.fade_from_m) + " m and "
                           + std::to_string(options.fade_to_m) + " m");
    if (options.wide_reach != 0.0 && !(options.wide_reach > options.reach))
        throw InvalidInput("the wide shadow map must reach farther than the near one, got "
                           + std::to_string(options.wide_reach) + " and " + std::to_string(options.reach));
}

ShadowBoxOptions box_options(const ShadowMapOptions& options, double reach)
{
    return {.texels = options.size, .reach = reach, .farthest_caster_m = options.farthest_caster_m};
}

std::array<BlockVec4, 8> disc_of(std::size_t samples)
{
    const auto points = poisson_disc(samples);
    std::array<BlockVec4, 8> disc = {};
    for (std::size_t i = 0; i < points.size(); ++i) {
        BlockVec4& two = disc.at(i / 2);
        (i % 2 == 0 ? two.x : two.z) = points[i][0];
        (i % 2 == 0 ? two.y : two.w) = points[i][1];
    }
    return disc;
}

// Depth as maps want it; as it was, afterwards.
class CasterDrawing {
public:
    explicit CasterDrawing(const ShadowMapOptions& options)
    {
        glGetIntegerv(GL_DEPTH_FUNC, &function_before_);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glEnable(GL_DEPTH_CLAMP);
        glEnable(GL_POLYGON_OFFSET_FILL);
        // What faces away is dark, and must shade itself: towards the light with it.
        const bool away = options.faces == CasterFaces::away_from_light;
        offset(options, away ? -1.0f : 1.0f);
        if (away) {
            glEnable(GL_CULL_FACE);
            glCullFace(GL_FRONT);
        }
    }
    CasterDrawing(const CasterDrawing&) = delete;
    CasterDrawing& operator=(const CasterDrawing&) = delete;
    ~CasterDrawing()
    {
        glCullFace(GL_BACK);
        glDisable(GL_CULL_FACE);
        glPolygonOffset(0.0f, 0.0f);
        glDisable(GL_POLYGON_OFFSET_FILL);
        glDisable(GL_DEPTH_CLAMP);
        glDepthFunc(static_cast<GLenum>(function_before_));
        glDisable(GL_DEPTH_TEST); // as SavedDrawing left it
    }

private:
    // A face that the light falls along would be moved so far that it lets light through.
    static void offset(const ShadowMapOptions& options, float sign)
    {
        // The sampler also compares texels beside a tap, up to a whole one away.
        const double reach = options.linear_compare ? 2.0 : 1.0;
        const float slope = sign * static_cast<float>(reach * options.slope_offset);
        const bool can_clamp =
            epoxy_gl_version() >= 46 || epoxy_has_gl_extension("GL_ARB_polygon_offset_clamp");
        if (can_clamp)
            glPolygonOffsetClamp(slope, sign * kConstantOffset,
                                 sign * kMostOffsetTexels / static_cast<float>(options.size));
        else
            glPolygonOffset(slope, sign * kConstantOffset);
    }

    GLint function_before_ = 0;
};

// Rows, then columns.
class Moments {
public:
    Moments(const ShaderSources& sources, std::size_t size)
        : by_rows_(TextureFormat::rg32f, size, size), all_(TextureFormat::rg32f, size, size),
          rows_(sources, screen_program("shadow_map_moments.frag.glsl", {{"DUSKLINE_ROWS", "1"}})),
          columns_(sources, screen_program("shadow_map_moments.frag.glsl", {{"DUSKLINE_ROWS", "0"}})),
          to_rows_({&by_rows_}), to_all_({&all_})
    {
        all_.set_filter(Texture::Filter::linear);
    }

    void filter(const Texture& depth) const
    {
        depth.bind(kShadowMapUnit);
        rows_.set("source", static_cast<int>(kShadowMapUnit));
        pass_.draw(rows_, to_rows_);
        by_rows_.bind(kShadowMapUnit);
        columns_.set("source", static_cast<int>(kShadowMapUnit));
        pass_.draw(columns_, to_all_);
    }

    const Texture& all() const { return all_; }

private:
    Texture by_rows_;
    Texture all_;
    Program rows_;
    Program columns_;
    Framebuffer to_rows_;
    Framebuffer to_all_;
    ScreenPass pass_;
};

} // namespace

// A box and its map.
struct ShadowMap::Part {
    Part(const ShaderSources& sources, const ShadowMapOptions& options, double reach)
        : follower(box_options(options, reach)), depth(TextureFormat::depth32f, options.size, options.size),
          framebuffer({}, &depth)
    {
        depth.set_outside(Texture::Outside::border, 1.0f);
        if (options.filter == ShadowMapFilter::moments) {
            moments.emplace(sources, options.size);
            return;
        }
        depth.compare_depth();
        depth.set_filter(options.linear_compare ? Texture::Filter::linear : Texture::Filter::nearest);
    }

    const Texture& looked_up() const { return moments ? moments->all() : depth; }

    ShadowBoxFollower follower;
    ShadowBox box; ///< of the last view
    std::optional<ShadowBox> drawn;
    Texture depth;
    Framebuffer framebuffer;
    std::optional<Moments> moments;
};

ShadowMap::ShadowMap(const ShaderSources& sources, const ShadowMapOptions& options) : options_(options)
{
    require_valid(options);
    disc_ = disc_of(options.samples);
    parts_.push_back(std::make_unique<Part>(sources, options, options.reach));
    if (options.wide_reach > 0.0)
        parts_.push_back(std::make_unique<Part>(sources, options, options.wide_reach));
}

ShadowMap::~ShadowMap() = default;

std::size_t ShadowMap::update(const ShadowView& view, const DrawCasters& draw_casters)
{
    const double faded =
        (view.clearance_m - options_.fade_from_m) / (options_.fade_to_m - options_.fade_from_m);
    strength_ = 1.0 - std::clamp(faded, 0.0, 1.0);
    std::size_t drawn = 0;
    for (const auto& part : parts_) {
        part->box = part->follower.follow(view);
        if (strength_ == 0.0 || (part->drawn && same_map(*part->drawn, part->box)))
            continue;
        draw(*part, draw_casters);
        ++drawn;
    }
    return drawn;
}

void ShadowMap::draw(Part& part, const DrawCasters& draw_casters) const
{
    {
        const SavedDrawing saved;
        part.framebuffer.clear();
        part.framebuffer.bind();
        const CasterDrawing casters(options_);
        draw_casters(part.box);
    }
    if (part.moments)
        part.moments->filter(part.depth);
    part.drawn = part.box;
}

void ShadowMap::casters_changed()
{
    for (const auto& part : parts_)
        part->drawn = std::nullopt;
}

std::vector<ShaderDefine> ShadowMap::defines() const
{
    return {{"DUSKLINE_SHADOW_MAP_FILTER", std::to_string(static_cast<int>(options_.filter))},
            {"DUSKLINE_SHADOW_MAP_PENUMBRA_ONLY", options_.penumbra_only ? "1" : "0"},
            {"DUSKLINE_SHADOW_MAPS", std::to_string(parts_.size())}};
}

ShadowMapBlock ShadowMap::block(const Vector3& eye_m, const ShadowMapLook& look) const
{
    const auto part_block = [&](const Part& part) {
        const auto rows = box_rows(part.box, eye_m);
        std::array<float, 4> borders = {};
        std::ranges::transform(kBorders, borders.begin(),
                               [&](double share) { return static_cast<float>(share * part.box.radius_m); });
        return ShadowMapPart{
            .to_column = as_block(rows[0]),
            .to_row = as_block(rows[1]),
            .to_depth = as_block(rows[2]),
            .borders = as_block(borders),
            .fade_begin_m = static_cast<float>(kFadeBegins * part.box.radius_m),
            .fade_end_m = static_cast<float>(part.box.radius_m),
            .texel = 1.0f / static_cast<float>(options_.size),
            .spread = static_cast<float>(options_.spread * std::lerp(1.0, kWidestSpread, look.overcast))};
    };
    ShadowMapBlock block;
    block.near_box = part_block(*parts_.front());
    block.wide_box = part_block(*parts_.back());
    block.disc = disc_;
    block.strength = static_cast<float>(strength_ * std::lerp(1.0, kFaintestShadow, look.overcast));
    block.overlay = static_cast<int>(look.overlay);
    block.samples = static_cast<int>(options_.samples);
    return block;
}

void ShadowMap::bind(const ShadowMapBlock& block, Buffer& buffer) const
{
    for (std::size_t i = 0; i < parts_.size(); ++i)
        parts_[i]->looked_up().bind(kShadowMapUnit + static_cast<unsigned int>(i));
    buffer.upload_block(block);
    buffer.bind_as_uniforms(kShadowMapUnit);
}

const ShadowBox& ShadowMap::box() const
{
    return parts_.front()->box;
}

const ShadowBox& ShadowMap::widest_box() const
{
    return parts_.back()->box;
}

const Texture& ShadowMap::depth() const
{
    return parts_.front()->depth;
}

std::vector<std::array<float, 2>> poisson_disc(std::size_t count)
{
    constexpr std::size_t kCandidates = 500;
    std::mt19937 random(20); // the same numbers everywhere, unlike distributions
    const auto number = [&] { return static_cast<float>(random() >> 8U) / 8388608.0f - 1.0f; };
    std::vector<std::array<float, 2>> points;
    while (points.size() < count) {
        std::array<float, 2> best = {};
        float best_apart = -1.0f;
        for (std::size_t i = 0; i < kCandidates; ++i) {
            const std::array<float, 2> candidate = {number(), number()};
            if (std::hypot(candidate[0], candidate[1]) > 1.0f)
                continue;
            float apart = 4.0f;
            for (const auto& other : points)
                apart = std::min(apart, std::hypot(candidate[0] - other[0], candidate[1] - other[1]));
            if (apart > best_apart) {
                best = candidate;
                best_apart = apart;
            }
        }
        points.push_back(best);
    }
    return points;
}

} // namespace duskline::gl
