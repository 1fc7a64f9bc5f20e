#pragma once

#include "run_options.h"

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace duskline::cli {

/// What a command tells its user: notes and warnings on stderr, the summary on stdout as text or, with
/// --json, as one object that holds the notes and warnings too.
class Report {
public:
    Report(std::string_view command, const RunOptions& options, std::string_view program = "duskline");

    /// Something assumed on the user's behalf. Shown with -v; always in the JSON.
    void note(std::string_view text);

    /// Something the user should look at; the result stands. Shown always.
    void warn(std::string_view text);

    /// A line of the summary for people, without its line end.
    void line(std::string_view text);

    /// A field of the summary for machines.
    template <typename T>
    void field(const std::string& name, const T& value)
    {
        json_[name] = value;
    }

    /// The summary for machines itself, for what is not one flat field.
    nlohmann::ordered_json& json() { return json_; }
    const nlohmann::ordered_json& json() const { return json_; }

    /// Writes the summary. Throws StandardOutputError when it cannot be written.
    void finish();

private:
    RunOptions options_;
    std::string program_; ///< whose name stands before notes and warnings
    std::string text_;
    nlohmann::ordered_json json_;
};

/// Writes to stdout and makes sure it got there. Throws StandardOutputError.
void write_to_stdout(std::string_view text);

} // namespace duskline::cli
