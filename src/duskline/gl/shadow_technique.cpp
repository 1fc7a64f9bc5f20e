#include <duskline/casting/light_frame.h>
#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/baked_shadows.h>
#include <duskline/gl/exact_upload.h>
#include <duskline/gl/gradual_upload.h>
#include <duskline/gl/shadow_sweep.h>
#include <duskline/gl/shadow_technique.h>
#include <duskline/gl/silhouette_passes.h>
#include <duskline/gl/terrain_shadow_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace duskline::gl {

namespace {

class NoShadows : public ShadowTechnique {
public:
    explicit NoShadows(const TerrainTextures&) {}
    void cast(const DirectionalLight&) override {}
    void heights_changed(const CellRectangle&) override {}
    TerrainShadow shadow() const override { return {}; }
};

// The sweep in compute passes, over all of the terrain for every light.
class SweptShadows : public ShadowTechnique {
public:
    SweptShadows(const ShaderSources& sources, const TerrainTextures& terrain, bool soft)
        : terrain_(terrain), sweep_(sources, {.limbs = soft}),
          lookup_(soft ? ShadowLookup::limbs : ShadowLookup::heights)
    {}

    void cast(const DirectionalLight& light) override
    {
        light_ = light;
        texture_ = &sweep_.cast(terrain_.heights(), terrain_.field().cell_size_m, light);
    }
    void heights_changed(const CellRectangle&) override { cast(light_); }
    TerrainShadow shadow() const override
    {
        return texture_ != nullptr ? TerrainShadow{lookup_, texture_} : TerrainShadow{};
    }

private:
    const TerrainTextures& terrain_;
    ShadowSweep sweep_;
    ShadowLookup lookup_;
    DirectionalLight light_;
    const Texture* texture_ = nullptr;
};

// The silhouette map, built anew for every light, or every line on the way to the light without it.
class SilhouetteShadows : public ShadowTechnique {
public:
    enum class LookUp {
        pixels, ///< each asks the map itself
        cells,  ///< all cells ask once a light, and pixels take their answers
        lines,  ///< each pixel looks at all lines
    };

    SilhouetteShadows(const ShaderSources& sources, const TerrainTextures& terrain, NextVSearch search,
                      LookUp look_up)
        : terrain_(terrain), passes_(sources, {.search = search}), look_up_(look_up),
          form_(look_up == LookUp::lines               ? ShadowLookup::lines
                : search == NextVSearch::parallel_quad ? ShadowLookup::silhouettes_by_four
                                                       : ShadowLookup::silhouettes),
          greatest_m_(greatest_height_m())
    {}

    void cast(const DirectionalLight& light) override
    {
        light_ = light;
        const CellSize cell_size_m = terrain_.field().cell_size_m;
        if (look_up_ == LookUp::lines)
            passes_.set_light(terrain_.heights(), cell_size_m, light, greatest_m_);
        else
            passes_.build(terrain_.heights(), cell_size_m, light, greatest_m_);
        // Light at the horizon and overhead has no map: the answer is one for all.
        shadow_ = look_up_ == LookUp::cells || uniform_answer(light)
                      ? TerrainShadow{ShadowLookup::mask, &passes_.mask(), nullptr}
                      : TerrainShadow{form_, nullptr, &passes_};
    }
    void heights_changed(const CellRectangle&) override
    {
        greatest_m_ = greatest_height_m();
        cast(light_);
    }
    TerrainShadow shadow() const override { return shadow_; }
    std::optional<double> black_share() const override
    {
        return look_up_ != LookUp::lines ? std::optional(passes_.black_share()) : std::nullopt;
    }

private:
    float greatest_height_m() const
    {
        const HeightRange range = height_range(terrain_.field());
        return range.lowest_m <= range.highest_m
                   ? std::max(std::abs(range.lowest_m), std::abs(range.highest_m))
                   : 0.0f;
    }

    const TerrainTextures& terrain_;
    SilhouettePasses passes_;
    LookUp look_up_;
    ShadowLookup form_;
    float greatest_m_;
    DirectionalLight light_;
    TerrainShadow shadow_;
};

template <NextVSearch kSearch, SilhouetteShadows::LookUp kLookUp = SilhouetteShadows::LookUp::pixels>
std::unique_ptr<ShadowTechnique> make_silhouette_shadows(const ShaderSources& sources,
                                                         const TerrainTextures& terrain, bool)
{
    return std::make_unique<SilhouetteShadows>(sources, terrain, kSearch, kLookUp);
}

constexpr auto kSilhouetteSource = "Sakalauskas, Hybrid Terrain Shadow Ray Casting, WSCG 2008";

constexpr auto kStriderSource = "Strahan, the Strider Technique, 2004";

std::unique_ptr<ShadowTechnique> make_exact(const ShaderSources&, const TerrainTextures& terrain, bool soft)
{
    if (soft)
        return std::make_unique<SoftExactUpload>(terrain);
    return std::make_unique<ExactUpload>(terrain);
}

// Those that need nothing but the terrain.
template <typename Technique>
std::unique_ptr<ShadowTechnique> make_of_terrain(const ShaderSources&, const TerrainTextures& terrain, bool)
{
    return std::make_unique<Technique>(terrain);
}

std::unique_ptr<ShadowTechnique> make_swept(const ShaderSources& sources, const TerrainTextures& terrain,
                                            bool soft)
{
    return std::make_unique<SweptShadows>(sources, terrain, soft);
}

std::unique_ptr<ShadowTechnique> make_shadow_map(const ShaderSources& sources, const TerrainTextures& terrain,
                                                 bool)
{
    return std::make_unique<TerrainShadowMap>(sources, terrain);
}

constexpr std::array kTechniques = {
    ShadowTechniqueKind{.name = "none",
                        .description = "no shadows: what everything else costs",
                        .source = "",
                        .make = make_of_terrain<NoShadows>},
    ShadowTechniqueKind{.name = "exact",
                        .description = "the caster exact on the processor, its mask uploaded",
                        .source = "casting/exact.h",
                        .has_soft_edges = true,
                        .make = make_exact},
    ShadowTechniqueKind{.name = "sweep",
                        .description = "the caster sweep in compute passes on the graphics card",
                        .source = "casting/sweep.h",
                        .has_soft_edges = true,
                        .make = make_swept},
    ShadowTechniqueKind{.name = "shadow-map",
                        .description = "a depth map that goes with the viewer; no shadows beyond it",
                        .source = "Shadow mapping on large terrain, Organic Vectory",
                        .make = make_shadow_map},
    ShadowTechniqueKind{.name = "full-scan",
                        .description = "every line on the way to the light, for every pixel",
                        .source = kSilhouetteSource,
                        .make =
                            make_silhouette_shadows<NextVSearch::binary, SilhouetteShadows::LookUp::lines>},
    ShadowTechniqueKind{.name = "smap-binary",
                        .description = "silhouette map, binary search",
                        .source = kSilhouetteSource,
                        .make = make_silhouette_shadows<NextVSearch::binary>},
    ShadowTechniqueKind{.name = "smap-quad",
                        .description = "silhouette map, quad search",
                        .source = kSilhouetteSource,
                        .make = make_silhouette_shadows<NextVSearch::quad>},
    ShadowTechniqueKind{.name = "smap-parallel",
                        .description = "silhouette map, quad search of four lines at a time",
                        .source = kSilhouetteSource,
                        .make = make_silhouette_shadows<NextVSearch::parallel_quad>},
    ShadowTechniqueKind{
        .name = "smap-cells",
        .description = "the same map, looked up for every cell and not for every pixel",
        .source = kSilhouetteSource,
        .make = make_silhouette_shadows<NextVSearch::parallel_quad, SilhouetteShadows::LookUp::cells>},
    ShadowTechniqueKind{.name = "strider",
                        .description = "the caster strider on the processor, a part in every frame",
                        .source = kStriderSource,
                        .make = make_of_terrain<GradualUpload>},
    ShadowTechniqueKind{.name = "baked",
                        .description = "shadow maps over the day, found before and blended",
                        .source = "light maps of a day",
                        .follows_course = true,
                        .make = make_of_terrain<BakedShadows>},
};

} // namespace

std::span<const ShadowTechniqueKind> shadow_techniques()
{
    return kTechniques;
}

const ShadowTechniqueKind& shadow_technique_named(std::string_view name)
{
    const auto found = std::ranges::find(kTechniques, name, &ShadowTechniqueKind::name);
    if (found != kTechniques.end())
        return *found;
    std::string names;
    for (const ShadowTechniqueKind& kind : kTechniques)
        names += (names.empty() ? "" : ", ") + std::string(kind.name);
    throw InvalidInput("no shadow technique is called '" + std::string(name) + "'; there are: " + names);
}

} // namespace duskline::gl
