#include "command_line.h"

#include <fcntl.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace duskline::cli_test {
namespace {

namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::chrono::seconds kPatience{600};
#else
constexpr std::chrono::seconds kPatience{60};
#endif

std::string content_of(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary);
    std::ostringstream content;
    content << file.rdbuf();
    return content.str();
}

fs::path new_folder()
{
    std::string name = (fs::temp_directory_path() / "duskline-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
        throw std::runtime_error("cannot make a folder " + name);
    return name;
}

int exit_code_of(int status)
{
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

int wait_patiently(pid_t process)
{
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    int status = 0;
    while (waitpid(process, &status, WNOHANG) == 0) {
        if (std::chrono::steady_clock::now() > deadline) {
            kill(process, SIGKILL);
            waitpid(process, &status, 0);
            ADD_FAILURE() << "the program ran for more than " << kPatience.count() << " s";
            break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return exit_code_of(status);
}

int opened_for_writing(const fs::path& path)
{
    return open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
}

[[noreturn]] void become(const Arguments& command, const fs::path& folder, int out, int err)
{
    std::vector<char*> words;
    for (const std::string& word : command)
        words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    const bool ready = chdir(folder.c_str()) == 0 && setenv("DUSKLINE", DUSKLINE_COMMAND, 1) == 0
                       && dup2(nothing, STDIN_FILENO) >= 0 && dup2(out, STDOUT_FILENO) >= 0
                       && dup2(err, STDERR_FILENO) >= 0;
    if (ready)
        execvp(words.front(), words.data());
    _exit(127);
}

Arguments with_program(const Arguments& arguments)
{
    Arguments command = {DUSKLINE_COMMAND};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return command;
}

// Everything a terminal's user would see, until the program closes it.
std::string shown_on(int terminal)
{
    std::string shown;
    char buffer[4096];
    for (ssize_t count = 0; (count = read(terminal, buffer, sizeof buffer)) > 0;)
        shown.append(buffer, static_cast<std::size_t>(count));
    std::erase(shown, '\r');
    return shown;
}

} // namespace

CommandLineTest::CommandLineTest() : folder_(new_folder()), capture_folder_(new_folder()) {}

CommandLineTest::~CommandLineTest()
{
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
    fs::remove_all(capture_folder_, ignored);
}

Finished CommandLineTest::run(const Arguments& arguments) const
{
    return run_program(with_program(arguments));
}

Finished CommandLineTest::run_program(const Arguments& command) const
{
    const pid_t process = fork();
    if (process == 0)
        become(command, folder_, opened_for_writing(capture_folder_ / "out"),
               opened_for_writing(capture_folder_ / "err"));
    return wait_for(process);
}

pid_t CommandLineTest::start(const Arguments& arguments) const
{
    const Arguments command = with_program(arguments);
    const pid_t process = fork();
    if (process == 0)
        become(command, folder_, opened_for_writing(capture_folder_ / "out"),
               opened_for_writing(capture_folder_ / "err"));
    return process;
}

Finished CommandLineTest::wait_for(pid_t process) const
{
    Finished finished;
    finished.exit_code = wait_patiently(process);
    finished.out = content_of(capture_folder_ / "out");
    finished.err = content_of(capture_folder_ / "err");
    return finished;
}

bool CommandLineTest::has_terminals()
{
    int ours = -1;
    int theirs = -1;
    if (openpty(&ours, &theirs, nullptr, nullptr, nullptr) != 0)
        return false;
    close(ours);
    close(theirs);
    return true;
}

Finished CommandLineTest::run_on_terminal(const Arguments& arguments) const
{
    const Arguments command = with_program(arguments);
    int ours = -1;
    int theirs = -1;
    if (openpty(&ours, &theirs, nullptr, nullptr, nullptr) != 0)
        throw std::runtime_error("cannot open a terminal");
    const pid_t process = fork();
    if (process == 0)
        become(command, folder_, opened_for_writing(capture_folder_ / "out"), theirs);
    close(theirs);
    const std::string shown = shown_on(ours);
    close(ours);
    Finished finished = wait_for(process);
    finished.err = shown;
    return finished;
}

void CommandLineTest::write_file(const std::string& name, const std::string& content) const
{
    std::ofstream(path(name), std::ios::binary) << content;
}

std::string CommandLineTest::read_file(const std::string& name) const
{
    return content_of(path(name));
}

std::vector<std::string> CommandLineTest::files() const
{
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_))
        names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

::testing::AssertionResult is_one_error_line(const std::string& err)
{
    const bool one_line = std::ranges::count(err, '\n') == 1 && err.ends_with('\n');
    if (err.starts_with("duskline: ") && !err.starts_with("duskline: warning") && one_line)
        return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "expected one line 'duskline: ...', got:\n" << err;
}

} // namespace duskline::cli_test
