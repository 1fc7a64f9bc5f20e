#include "report.h"

#include "exit_code.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace duskline::cli {

Report::Report(std::string_view command, const RunOptions& options, std::string_view program)
    : options_(options), program_(program)
{
    json_["command"] = command;
    json_["notes"] = nlohmann::json::array();
    json_["warnings"] = nlohmann::json::array();
}

void Report::note(std::string_view text)
{
    json_["notes"].push_back(text);
    if (options_.verbose)
        std::fprintf(stderr, "%s: note: %.*s\n", program_.c_str(), static_cast<int>(text.size()),
                     text.data());
}

void Report::warn(std::string_view text)
{
    json_["warnings"].push_back(text);
    std::fprintf(stderr, "%s: warning: %.*s\n", program_.c_str(), static_cast<int>(text.size()), text.data());
}

void Report::line(std::string_view text)
{
    text_ += text;
    text_ += '\n';
}

void Report::finish()
{
    if (options_.json)
        write_to_stdout(json_.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    else if (!options_.quiet)
        write_to_stdout(text_);
}

void write_to_stdout(std::string_view text)
{
    const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
    if (!written || std::fflush(stdout) != 0)
        throw StandardOutputError(std::string("cannot write to standard output: ") + std::strerror(errno));
}

} // namespace duskline::cli
