#include <duskline/gl/baked_shadows.h>

#include <algorithm>
#include <chrono>

namespace duskline::gl {

BakedShadows::BakedShadows(const TerrainTextures& terrain)
    : shadows_(terrain.field()), upload_(terrain.field().rows(), terrain.field().columns())
{}

void BakedShadows::set_course(const LightCourse& course)
{
    course_ = course;
    has_course_ = !course.lights.empty();
    maps_.resize(course.lights.size());
    for (Map& map : maps_)
        map.is_made = false;
    if (light_)
        cast(DirectionalLight(*light_));
}

void BakedShadows::cast(const DirectionalLight& light)
{
    require_valid(light);
    if (!has_course_) {
        course_ = {{light}};
        maps_.resize(1);
        maps_[0].is_made = false;
    }
    light_ = light;
    place_ = nearest_place(course_, light);
    make(place_.before);
    make(place_.after);
}

void BakedShadows::heights_changed(const CellRectangle& rectangle)
{
    shadows_.heights_changed(rectangle);
    for (Map& map : maps_)
        map.is_made = false;
    if (light_)
        cast(DirectionalLight(*light_));
}

void BakedShadows::advance(std::chrono::microseconds budget)
{
    const auto end = std::chrono::steady_clock::now() + budget;
    for (std::size_t i = 0; i < maps_.size(); ++i) {
        const std::size_t next = (place_.after + i) % maps_.size();
        if (maps_[next].is_made)
            continue;
        make(next);
        if (std::chrono::steady_clock::now() >= end)
            return;
    }
}

double BakedShadows::done() const
{
    const auto made = std::ranges::count_if(maps_, &Map::is_made);
    return maps_.empty() ? 1.0 : static_cast<double>(made) / static_cast<double>(maps_.size());
}

TerrainShadow BakedShadows::shadow() const
{
    if (!light_)
        return {};
    const Texture& before = *maps_[place_.before].texture;
    if (place_.before == place_.after)
        return {ShadowLookup::mask, &before};
    TerrainShadow shadow = {ShadowLookup::two_masks, &before};
    shadow.later = &*maps_[place_.after].texture;
    shadow.later_share = static_cast<float>(place_.share);
    return shadow;
}

void BakedShadows::make(std::size_t map)
{
    auto& [texture, is_made] = maps_[map];
    if (is_made)
        return;
    if (!texture)
        texture = upload_.new_texture();
    upload_.upload(shadows_.cast(course_.lights[map]), *texture);
    is_made = true;
}

} // namespace duskline::gl
