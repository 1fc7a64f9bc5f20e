#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/lamp_maps.h>
#include <duskline/gl/reversed_depth.h>
#include <duskline/gl/saved_drawing.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <string>

namespace duskline::gl {

namespace {

// Lower than any cosine: all round.
constexpr float kNoBeam = -2.0f;
// A border as thin as that has no width in a picture.
constexpr double kSharpestBeam = 1e-5;
// The sampler also compares texels beside a tap, up to a whole one away.
constexpr double kTexelsOfATap = 2.0;
// In the smallest steps of depth, against roundings of large triangles.
constexpr float kConstantOffset = 4.0f;

void require_valid(const LampMapOptions& options)
{
    if (options.size < 64)
        throw InvalidInput("maps of lamps need 64 or more texels a side, got "
                           + std::to_string(options.size));
    if (options.taps < 1 || options.taps > 5)
        throw InvalidInput("kernels of lamps have 1 to 5 taps a side, got " + std::to_string(options.taps));
    if (!(options.slope_offset >= 0.0))
        throw InvalidInput("the slope offset of maps of lamps must be 0 or more, got "
                           + std::to_string(options.slope_offset));
}

void require_valid(std::span<const SceneLamp> lamps)
{
    if (lamps.size() > kMostLamps)
        throw InvalidInput("at most " + std::to_string(kMostLamps) + " lamps may shine at a time, got "
                           + std::to_string(lamps.size()));
    for (const SceneLamp& lamp : lamps)
        duskline::require_valid(lamp);
}

// Away from the lamp, where depth is smaller.
class OffsetFromLamp {
public:
    explicit OffsetFromLamp(double slope_offset)
    {
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(static_cast<float>(-kTexelsOfATap * slope_offset), -kConstantOffset);
    }
    OffsetFromLamp(const OffsetFromLamp&) = delete;
    OffsetFromLamp& operator=(const OffsetFromLamp&) = delete;
    ~OffsetFromLamp()
    {
        glPolygonOffset(0.0f, 0.0f);
        glDisable(GL_POLYGON_OFFSET_FILL);
    }
};

BlockVec4 with(const Vector3& v, double w)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

// The beam: its axis, the cosine at its border, and how steeply light grows inwards from there.
void set_beam(LampOnCard& card, const SceneLamp& lamp)
{
    card.axis.w = kNoBeam;
    card.light.w = 1.0f;
    if (!is_searchlight(lamp))
        return;
    const double outer = sine_cosine(lamp.half_angle).cosine;
    const Angle full = Angle::from_degrees((1.0 - lamp.soft_edge) * lamp.half_angle.degrees());
    const double growth = std::max(sine_cosine(full).cosine - outer, kSharpestBeam);
    card.axis = with(normalized(lamp.direction), outer);
    card.light.w = static_cast<float>(1.0 / growth);
}

LampOnCard on_card(const SceneLamp& lamp, const LampFace& first, const Vector3& eye_m)
{
    const float at_1_m = static_cast<float>(lamp.bright_m * lamp.bright_m);
    LampOnCard card;
    // The one difference of large numbers, in double.
    card.place = with(lamp.position_m - eye_m, lamp.range_m);
    card.light = {lamp.colour[0] * at_1_m, lamp.colour[1] * at_1_m, lamp.colour[2] * at_1_m, 1.0f};
    card.right = with(first.axes.right, 1.0 / first.half_width);
    card.up = with(first.axes.up, 0.0);
    set_beam(card, lamp);
    return card;
}

} // namespace

LampMaps::LampMaps(const LampMapOptions& options) : options_(options)
{
    require_valid(options);
    require_reversed_depth();
}

void LampMaps::make_room(std::size_t faces)
{
    if (faces <= layers_.size())
        return;
    depth_.reset(); // so that both are never there
    layers_.clear();
    depth_.emplace(TextureFormat::depth32f, options_.size, options_.size, faces);
    depth_->compare_reversed_depth();
    layers_.resize(faces);
}

std::optional<std::size_t> LampMaps::layer_of(const LampFace& face) const
{
    const auto found = std::ranges::find_if(
        layers_, [&](const Layer& layer) { return layer.drawn && same_map(*layer.drawn, face); });
    if (found == layers_.end())
        return std::nullopt;
    return static_cast<std::size_t>(found - layers_.begin());
}

std::size_t LampMaps::free_layer() const
{
    const auto unused =
        std::ranges::find_if(layers_, [](const Layer& layer) { return !layer.wanted && !layer.drawn; });
    const auto found = unused != layers_.end() ? unused : std::ranges::find(layers_, false, &Layer::wanted);
    return static_cast<std::size_t>(found - layers_.begin());
}

std::size_t LampMaps::update(std::span<const SceneLamp> lamps, const DrawLampCasters& draw_casters)
{
    require_valid(lamps);
    std::vector<std::vector<LampFace>> faces;
    std::size_t count = 0;
    for (const SceneLamp& lamp : lamps)
        count += faces.emplace_back(lamp_faces(lamp, options_.size)).size();
    lamps_.clear(); // should drawing fail
    layers_of_lamps_.assign(lamps.size(), {});
    make_room(count);
    // Layers that stay are taken before any is given away.
    for (Layer& layer : layers_)
        layer.wanted = false;
    for (const auto& of_lamp : faces)
        for (const LampFace& face : of_lamp)
            if (const auto layer = layer_of(face))
                layers_.at(*layer).wanted = true;
    std::size_t drawn = 0;
    for (std::size_t i = 0; i < lamps.size(); ++i)
        for (const LampFace& face : faces[i]) {
            std::optional<std::size_t> layer = layer_of(face);
            if (!layer) {
                layer = free_layer();
                draw(*layer, face, draw_casters);
                ++drawn;
            }
            layers_of_lamps_[i].push_back(*layer);
        }
    lamps_.assign(lamps.begin(), lamps.end());
    return drawn;
}

void LampMaps::draw(std::size_t layer, const LampFace& face, const DrawLampCasters& draw_casters)
{
    layers_.at(layer) = {std::nullopt, true};
    const SavedDrawing saved;
    const Framebuffer framebuffer(*depth_, layer);
    framebuffer.bind();
    {
        const ReversedDepth reversed;
        const OffsetFromLamp offset(options_.slope_offset);
        draw_casters(face);
    }
    layers_.at(layer).drawn = face;
}

void LampMaps::casters_changed()
{
    for (Layer& layer : layers_)
        layer.drawn = std::nullopt;
}

LampBlock LampMaps::block(const Vector3& eye_m) const
{
    LampBlock block;
    for (std::size_t i = 0; i < lamps_.size(); ++i) {
        const std::vector<std::size_t>& layers = layers_of_lamps_[i];
        LampOnCard& card = block.lamps.at(i);
        card = on_card(lamps_[i], lamp_faces(lamps_[i], options_.size).front(), eye_m);
        card.faces = static_cast<int>(layers.size());
        std::ranges::transform(layers, card.layers.begin(),
                               [](std::size_t layer) { return static_cast<int>(layer); });
    }
    block.count = static_cast<int>(lamps_.size());
    block.taps = static_cast<int>(options_.taps);
    block.texel = 1.0f / static_cast<float>(options_.size);
    block.nearest_m = static_cast<float>(kNearestToLamp_m);
    return block;
}

void LampMaps::bind(const LampBlock& block, Buffer& buffer) const
{
    if (depth_)
        depth_->bind(kLampMapsUnit);
    buffer.upload_block(block);
    buffer.bind_as_uniforms(kLampMapsUnit);
}

} // namespace duskline::gl
