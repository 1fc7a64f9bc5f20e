#pragma once

#include <duskline/geometry/cell_rectangle.h>
#include <duskline/gl/shader_sources.h>
#include <duskline/gl/shadow_lookup.h>
#include <duskline/gl/terrain_textures.h>
#include <duskline/light/directional_light.h>
#include <duskline/light/light_course.h>

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace duskline::gl {

struct ShadowMapLook;
struct TerrainView;

/// The shadows of one terrain under a moving light, as some technique finds them.
class ShadowTechnique {
public:
    ShadowTechnique() = default;
    ShadowTechnique(const ShadowTechnique&) = delete;
    ShadowTechnique& operator=(const ShadowTechnique&) = delete;
    virtual ~ShadowTechnique() = default;

    /// To be called before `cast` for every picture: says whether shadows have to be cast again for that view. Most
    /// techniques have shadows everywhere.
    virtual bool look_from(const TerrainView&) { return false; }

    /// Finds the shadows of a light. Throws InvalidInput for angles out of range.
    virtual void cast(const DirectionalLight& light) = 0;

    /// To be called when heights have changed in a rectangle, after the textures' own `heights_changed`: brings the
    /// shadows of the light cast last up to date.
    virtual void heights_changed(const CellRectangle& rectangle) = 0;

    /// The shadows cast last, or for techniques that take their time the last that are whole.
    virtual TerrainShadow shadow() const = 0;

    /// To be called in every frame, by techniques that spread their work over frames to go on with it, for about so
    /// long; does nothing when all is done.
    virtual void advance(std::chrono::microseconds budget) { static_cast<void>(budget); }

    /// What share of the work is done, 0 to 1: 1 when `advance` has nothing to do, and shadows are those of the light cast
    /// last and of the heights there are.
    virtual double done() const { return 1.0; }

    /// Tells techniques that follow a course (ShadowTechniqueKind) which way the lights to come will go.
    virtual void set_course(const LightCourse& course) { static_cast<void>(course); }

    /// Of a silhouette map the share of texels that are Black, which hold a silhouette. Reads the map back.
    virtual std::optional<double> black_share() const { return std::nullopt; }

    /// For techniques with a shadow map: how it is shown.
    virtual void set_look(const ShadowMapLook&) {}
};

/// One way to find shadows in real time. The viewer, its report and the tests iterate over `shadow_techniques()`.
struct ShadowTechniqueKind {
    std::string_view name;        ///< as typed after --technique
    std::string_view description; ///< one line
    std::string_view source;      ///< where the method comes from
    bool has_soft_edges = false;  ///< whether it can do the whole of the light's disc
    bool follows_course = false;  ///< whether it prepares itself for the way of the light

    /// The terrain must outlive it. `soft` edges only where there are some. Throws ShaderError.
    std::unique_ptr<ShadowTechnique> (*make)(const ShaderSources& sources, const TerrainTextures& terrain,
                                             bool soft);
};

/// Every technique there is.
std::span<const ShadowTechniqueKind> shadow_techniques();

/// The technique of that name. Throws InvalidInput, listing the names there are.
const ShadowTechniqueKind& shadow_technique_named(std::string_view name);

} // namespace duskline::gl
