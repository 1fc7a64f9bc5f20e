#pragma once

#include "cli11_names.h"

#include <duskline/casting/casters.h>

#include <string>

namespace duskline::cli {

/// Adds --caster; `name` stays empty when it is not given. It must outlive `app`'s parsing.
void add_caster_option(CLI::App& app, std::string& name);

/// The best there is for one answer about a whole raster.
const Caster& default_caster();

/// The caster of that name, or with an empty one the default. Throws InvalidInput, listing the names.
const Caster& chosen_caster(const std::string& name);

} // namespace duskline::cli
