#include <duskline/casting/casters.h>

#include <algorithm>
#include <string>

namespace duskline {

const Caster& caster_named(std::string_view name)
{
    const auto found = std::ranges::find(kCasters, name, &Caster::name);
    if (found != kCasters.end())
        return *found;
    std::string names;
    for (const Caster& caster : kCasters)
        names += (names.empty() ? "" : ", ") + std::string(caster.name);
    throw InvalidInput("no caster is called '" + std::string(name) + "'; there are: " + names);
}

} // namespace duskline
