#include <duskline/raster_io/same_file.h>

#include <sys/stat.h>

#include <optional>
#include <utility>

namespace duskline {

namespace {

using FileIdentity = std::pair<dev_t, ino_t>;

std::optional<FileIdentity> identity_of(const std::string& path)
{
    struct stat status = {};
    if (path.empty() || stat(path.c_str(), &status) != 0 || S_ISDIR(status.st_mode))
        return std::nullopt;
    return FileIdentity(status.st_dev, status.st_ino);
}

// "/vsizip/vsigzip//data/a.zip/b.tif" -> "/data/a.zip/b.tif"
std::string without_virtual_prefix(std::string path)
{
    while (path.starts_with("/vsi")) {
        const std::size_t end = path.find('/', 4);
        if (end == std::string::npos)
            break;
        path.erase(0, end + 1);
    }
    return path;
}

// The file on disk that a GDAL name is about; of a virtual name, the longest leading part that is a file.
std::optional<FileIdentity> file_behind(const std::string& name)
{
    if (const auto identity = identity_of(name))
        return identity;
    if (!name.starts_with("/vsi") || name.starts_with("/vsimem/"))
        return std::nullopt;
    std::string path = without_virtual_prefix(name);
    while (!path.empty()) {
        if (const auto identity = identity_of(path))
            return identity;
        const std::size_t slash = path.rfind('/');
        if (slash == std::string::npos)
            break;
        path.erase(slash);
    }
    return std::nullopt;
}

} // namespace

bool is_same_file(const std::string& a, const std::string& b)
{
    if (a == b)
        return true;
    const auto first = file_behind(a);
    return first && first == file_behind(b);
}

} // namespace duskline
