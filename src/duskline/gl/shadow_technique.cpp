#include <duskline/geometry/invalid_input.h>
#include <duskline/gl/exact_upload.h>
#include <duskline/gl/shadow_sweep.h>
#include <duskline/gl/shadow_technique.h>

#include <algorithm>
#include <array>
#include <string>

namespace duskline::gl {

namespace {

class NoShadows : public ShadowTechnique {
public:
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

constexpr std::array kTechniques = {
    ShadowTechniqueKind{"none", "no shadows: what everything else costs", "", false,
                        [](const ShaderSources&, const TerrainTextures&, bool)
                            -> std::unique_ptr<ShadowTechnique> { return std::make_unique<NoShadows>(); }},
    ShadowTechniqueKind{
        "exact", "the caster exact on the processor, its mask uploaded", "casting/exact.h", false,
        [](const ShaderSources&, const TerrainTextures& terrain, bool) -> std::unique_ptr<ShadowTechnique> {
            return std::make_unique<ExactUpload>(terrain);
        }},
    ShadowTechniqueKind{"sweep", "the caster sweep in compute passes on the graphics card", "casting/sweep.h",
                        true,
                        [](const ShaderSources& sources, const TerrainTextures& terrain,
                           bool soft) -> std::unique_ptr<ShadowTechnique> {
                            return std::make_unique<SweptShadows>(sources, terrain, soft);
                        }},
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
