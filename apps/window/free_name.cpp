#include "free_name.h"

#include <fmt/format.h>

#include <filesystem>

namespace duskline::window {

std::string free_name(const std::string& name, const std::string& extension)
{
    for (int i = 1;; ++i) {
        std::string path = fmt::format("{}-{:04}{}", name, i, extension);
        if (!std::filesystem::exists(path))
            return path;
    }
}

} // namespace duskline::window
