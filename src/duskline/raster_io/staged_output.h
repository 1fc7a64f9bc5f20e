#pragma once

#include <functional>
#include <string>

namespace duskline {

/// A result in the making: written to a hidden folder `.duskline-NAME-XXXXXX` beside its place, and moved
/// there once whole. Files that its driver writes beside it (.hdr, .prj, .aux.xml) move along. Without
/// `publish` nothing stays but, after a kill, that folder.
///
/// Names in GDAL's virtual file systems (/vsimem/, /vsis3/) have no such folder: they are written where they
/// belong, and removed again when they are not completed.
class StagedOutput {
public:
    /// Throws OutputError when `target` may not be written, for a reason that can be known now.
    StagedOutput(const std::string& target, bool overwrite);
    ~StagedOutput();
    StagedOutput(const StagedOutput&) = delete;
    StagedOutput& operator=(const StagedOutput&) = delete;

    const std::string& target() const { return target_; }

    /// Where to write the result.
    const std::string& path() const { return path_; }

    /// A name in the same folder for files that are not part of the result.
    std::string scratch_path(const std::string& name) const { return scratch_folder_ + "/" + name; }

    /// A new folder there; a trial of the result in it shows which files it will have.
    std::string make_scratch_folder(const std::string& name) const;

    /// Throws OutputError when a file that would lie beside the result as `name` is there and may not be
    /// replaced, or is one of those that may never be.
    void require_replaceable_companion(const std::string& name,
                                       const std::function<bool(const std::string&)>& is_input) const;

    /// Brings everything to disk and moves it to its place. Throws OutputError.
    void publish();

    /// Whether a file of some size can be written here: is it the format, or the disk?
    bool takes_bytes() const;

    /// Of the file system the result goes to; for messages. 0 when not known.
    double free_mebibytes() const;

private:
    void require_replaceable() const;
    void make_folders();
    void move_in_place(const std::string& name) const;
    void remove_outdated_companions() const;
    void discard();

    std::string target_; ///< links followed
    std::string shown_;  ///< as the user wrote it
    bool overwrite_ = false;
    bool is_virtual_ = false;
    bool published_ = false;
    std::string path_;
    std::string folder_;        ///< of the target
    std::string result_folder_; ///< empty for virtual targets
    std::string scratch_folder_;
};

} // namespace duskline
