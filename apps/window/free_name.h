#pragma once

#include <string>

namespace duskline::window {

/// NAME-0001.EXTENSION, the first that is not there; `extension` with its point.
std::string free_name(const std::string& name, const std::string& extension);

} // namespace duskline::window
