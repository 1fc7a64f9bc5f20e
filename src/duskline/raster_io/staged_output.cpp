#include <duskline/raster_io/file_errors.h>
#include <duskline/raster_io/gdal_session.h>
#include <duskline/raster_io/staged_output.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <vector>

namespace duskline {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& path, const std::string& why)
{
    throw OutputError("cannot write '" + path + "': " + why);
}

// The file that a chain of links ends at, there or not.
fs::path without_links(fs::path path)
{
    std::error_code error;
    for (int links = 0; links < 40 && fs::is_symlink(fs::symlink_status(path, error)); ++links) {
        const fs::path next = fs::read_symlink(path, error);
        path = next.is_absolute() ? next : path.parent_path() / next;
    }
    return path;
}

void sync_to_disk(const fs::path& path, const std::string& shown)
{
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    const int result = file >= 0 ? fsync(file) : -1;
    const int problem = errno;
    if (file >= 0)
        close(file);
    // Some file systems cannot sync a folder.
    if (result != 0 && problem != EINVAL)
        refuse(shown, std::string("it does not reach the disk: ") + std::strerror(problem));
}

std::string made_folder(std::string name, const std::string& shown, const fs::path& parent)
{
    if (mkdtemp(name.data()) != nullptr)
        return name;
    const int problem = errno;
    if (problem == ENOENT)
        refuse(shown, "there is no folder " + parent.string());
    if (problem == ENOTDIR)
        refuse(shown, parent.string() + " is no folder");
    refuse(shown, "nothing can be written in " + parent.string() + ": " + std::strerror(problem));
}

} // namespace

StagedOutput::StagedOutput(const std::string& target, bool overwrite)
    : target_(target), shown_(target), overwrite_(overwrite), is_virtual_(target.starts_with("/vsi"))
{
    if (!is_virtual_)
        target_ = without_links(target).string();
    require_replaceable();
    make_folders();
}

StagedOutput::~StagedOutput()
{
    discard();
}

void StagedOutput::require_replaceable() const
{
    if (is_virtual_) {
        VSIStatBufL status = {};
        if (!overwrite_ && VSIStatL(target_.c_str(), &status) == 0)
            refuse(shown_, "it exists; --overwrite replaces it");
        return;
    }
    if (fs::path(target_).filename().empty())
        refuse(shown_, "give the name of a file");
    struct stat status = {};
    if (stat(target_.c_str(), &status) != 0)
        return;
    if (S_ISDIR(status.st_mode))
        refuse(shown_, "it is a folder");
    if (!S_ISREG(status.st_mode))
        refuse(shown_, "it is no ordinary file");
    if (!overwrite_)
        refuse(shown_, "it exists; --overwrite replaces it");
}

std::string StagedOutput::make_scratch_folder(const std::string& name) const
{
    std::string folder = scratch_path(name);
    if (mkdir(folder.c_str(), 0777) != 0)
        refuse(shown_, std::strerror(errno));
    return folder;
}

void StagedOutput::require_replaceable_companion(
    const std::string& name, const std::function<bool(const std::string&)>& is_input) const
{
    const std::string companion = (fs::path(target_).parent_path() / name).string();
    if (is_input(companion))
        refuse(shown_, "it would come with '" + companion + "', which is part of the input");
    if (!overwrite_ && fs::exists(companion))
        refuse(shown_, "it would come with '" + companion + "', which exists; --overwrite replaces it");
}

void StagedOutput::make_folders()
{
    if (is_virtual_) {
        path_ = target_;
        const fs::path temporary = fs::temp_directory_path();
        scratch_folder_ = made_folder((temporary / "duskline-XXXXXX").string(), shown_, temporary);
        return;
    }
    const fs::path target(target_);
    const fs::path parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
    folder_ = parent.string();
    const std::string name = target.filename().string();
    scratch_folder_ =
        made_folder((parent / (".duskline-" + name.substr(0, 100) + "-XXXXXX")).string(), shown_, parent);
    result_folder_ = scratch_folder_ + "/result";
    if (mkdir(result_folder_.c_str(), 0777) != 0)
        refuse(shown_, std::strerror(errno));
    path_ = result_folder_ + "/" + name;
}

void StagedOutput::publish()
{
    if (!is_virtual_) {
        const std::string main = fs::path(target_).filename().string();
        std::vector<std::string> companions;
        for (const auto& entry : fs::recursive_directory_iterator(result_folder_))
            sync_to_disk(entry.path(), shown_);
        for (const auto& entry : fs::directory_iterator(result_folder_))
            if (entry.path().filename() != main)
                companions.push_back(entry.path().filename().string());
        remove_outdated_companions(); // while the new ones are still where they are looked for
        for (const std::string& name : companions)
            move_in_place(name);
        move_in_place(main);
        sync_to_disk(folder_, shown_);
    }
    published_ = true;
    discard();
}

void StagedOutput::move_in_place(const std::string& name) const
{
    const std::string from = result_folder_ + "/" + name;
    const std::string to = (fs::path(folder_) / name).string();
    if (!overwrite_ && renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0)
        return;
    if (!overwrite_ && errno == EEXIST)
        refuse(shown_, "'" + to + "' exists; --overwrite replaces it");
    if (std::rename(from.c_str(), to.c_str()) != 0)
        refuse(shown_, "it cannot be moved in place as '" + to + "': " + std::strerror(errno));
}

// Statistics, overviews and masks of the file that is being replaced do not fit the new one.
void StagedOutput::remove_outdated_companions() const
{
    for (const char* extension : {".aux.xml", ".ovr", ".msk"})
        if (overwrite_ && !fs::exists(path_ + extension) && fs::exists(target_))
            fs::remove(target_ + extension);
}

void StagedOutput::discard()
{
    std::error_code ignored;
    if (!scratch_folder_.empty())
        fs::remove_all(scratch_folder_, ignored);
    scratch_folder_.clear();
    if (is_virtual_ && !published_) {
        const GdalErrors quiet;
        VSIUnlink(target_.c_str());
    }
}

bool StagedOutput::takes_bytes() const
{
    const std::string path = scratch_path("bytes");
    std::ofstream file(path, std::ios::binary);
    file << std::string(std::size_t{1} << 20U, '.') << std::flush;
    const bool written = file.good();
    file.close();
    std::error_code ignored;
    fs::remove(path, ignored);
    return written;
}

double StagedOutput::free_mebibytes() const
{
    std::error_code error;
    const auto space = fs::space(scratch_folder_, error);
    return error ? 0.0 : static_cast<double>(space.available) / 1024.0 / 1024.0;
}

} // namespace duskline
