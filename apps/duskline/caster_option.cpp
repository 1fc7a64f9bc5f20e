#include "caster_option.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace duskline::cli {

void add_caster_option(CLI::App& app, std::string& name)
{
    std::string text = "how to find the shadows:";
    for (const Caster& caster : kCasters)
        text += fmt::format("{} {} ({})", &caster == &kCasters.front() ? "" : ",", caster.name,
                            caster.description);
    app.add_option("--caster", name, text)
        ->type_name("NAME")
        ->default_str(std::string(default_caster().name))
        ->group("Running");
}

const Caster& default_caster()
{
    const auto exact = std::ranges::find(kCasters, "exact", &Caster::name);
    return exact != kCasters.end() ? *exact : caster_named("sweep");
}

const Caster& chosen_caster(const std::string& name)
{
    return name.empty() ? default_caster() : caster_named(name);
}

} // namespace duskline::cli
