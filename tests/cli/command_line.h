#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace duskline::cli_test {

/// What a program left behind.
struct Finished {
    int exit_code = -1; ///< 128 + signal when a signal killed it, as a shell says it
    std::string out;    ///< all of stdout
    std::string err;    ///< all of stderr
};

using Arguments = std::vector<std::string>;

/// A test that runs the real program, in a folder of its own that goes away afterwards. Paths without a
/// folder lie in that one.
class CommandLineTest : public ::testing::Test {
protected:
    CommandLineTest();
    ~CommandLineTest() override;

    /// Runs `duskline ARGUMENTS...` to its end; kills it, and fails the test, after a minute (ten with sanitizers).
    Finished run(const Arguments& arguments) const;

    /// Whether this machine lets a program open a terminal; a bare container may not.
    static bool has_terminals();

    /// The same with stderr on a terminal, where a progress bar shows. What it shows is in `err`.
    Finished run_on_terminal(const Arguments& arguments) const;

    /// Runs any program, say {"sh", "-c", "..."}. "$DUSKLINE" is the program under test.
    Finished run_program(const Arguments& command) const;

    /// Starts `duskline ARGUMENTS...` and returns its process; end it with `wait_for`.
    pid_t start(const Arguments& arguments) const;
    Finished wait_for(pid_t process) const;

    const std::filesystem::path& folder() const { return folder_; }
    std::filesystem::path path(const std::string& name) const { return folder_ / name; }
    void write_file(const std::string& name, const std::string& content) const;
    std::string read_file(const std::string& name) const;

    /// Names of the files in the folder, sorted: to see that nothing half-written stays.
    std::vector<std::string> files() const;

private:
    std::filesystem::path folder_;
    std::filesystem::path capture_folder_;
};

/// One line that starts with "duskline: ", and nothing else: how every error must look.
::testing::AssertionResult is_one_error_line(const std::string& err);

} // namespace duskline::cli_test
