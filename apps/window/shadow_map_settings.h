#pragma once

#include <duskline/gl/shadow_map.h>

#include <string>
#include <string_view>

namespace duskline::window {

/// How the technique shadow-map is set, and how it is shown.
struct ShadowMapSettings {
    gl::ShadowMapOptions options;
    gl::ShadowMapLook look;
};

/// The technique that has them.
inline constexpr std::string_view kShadowMapTechnique = "shadow-map";

/// Reads "filter=disc,size=2048"; what is not named has its usual value. Throws InvalidInput with the name and what would
/// be right.
ShadowMapSettings parse_shadow_map(const std::string& text);

/// The same as typed after --shadow-map. Throws UsageError, which names the option.
ShadowMapSettings parse_shadow_map_option(const std::string& typed);

/// The same settings as a text: all that are not usual. Equal settings have equal texts.
std::string text_of(const ShadowMapSettings& settings);

/// One line for help texts.
std::string shadow_map_help();

} // namespace duskline::window
