#include "help_page.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

namespace duskline::cli {
namespace {

constexpr std::size_t kTextWidth = 80;
constexpr std::size_t kOptionIndent = 26;

struct OptionText {
    std::string names; // "-z, --z-factor F"
    std::string text;
};

struct OptionGroup {
    std::string title;
    std::vector<OptionText> options;
};

struct Example {
    std::string what;
    std::string command_line;
};

// What both --help and the manual page say.
struct HelpPage {
    std::string name; // "duskline sun"
    std::string summary;
    std::string synopsis;
    std::vector<std::string> details;
    std::vector<OptionGroup> groups;
    std::vector<OptionText> commands;
    std::vector<Example> examples;
};

constexpr std::pair<std::string_view, std::string_view> kExitCodes[] = {
    {"0", "done, and the output is complete"},
    {"1", "failed while running"},
    {"2", "wrong options or values"},
    {"3", "the input cannot be used"},
    {"4", "the output cannot be written"},
    {"5", "not enough memory, or not possible on this machine"},
    {"130, 143", "interrupted by Ctrl-C or by SIGTERM"},
};

constexpr std::pair<std::string_view, std::string_view> kEnvironment[] = {
    {"DUSKLINE_KERNELS",
     "SIMD code to use: scalar, ssse3, sse4, avx2 or avx512; else the best that the processor "
     "runs. No result depends on it."},
};

// CLI11 keeps one text for the description and one for the footer. Paragraphs of the first: the summary, then
// the details. Lines of the second in pairs: what an example does, its command line.
std::vector<std::string> split(const std::string& text, const std::string& separator)
{
    std::vector<std::string> parts;
    std::size_t from = 0;
    while (from < text.size()) {
        const std::size_t to = std::min(text.find(separator, from), text.size());
        parts.push_back(text.substr(from, to - from));
        from = to + separator.size();
    }
    return parts;
}

OptionText described(const CLI::Option& option)
{
    OptionText result{option.get_positional() ? option.get_name(true) : option.get_name(false, true),
                      option.get_description()};
    for (std::size_t comma = 0; (comma = result.names.find(',', comma)) != std::string::npos; ++comma)
        result.names.replace(comma, 1, ", ");
    if (!option.get_positional() && option.get_items_expected_max() > 0)
        result.names += " " + option.get_type_name();
    if (!option.get_default_str().empty())
        result.text += fmt::format(" (default {})", option.get_default_str());
    return result;
}

OptionGroup& group_named(std::vector<OptionGroup>& groups, const std::string& title)
{
    const auto found = std::ranges::find(groups, title, &OptionGroup::title);
    if (found != groups.end())
        return *found;
    return groups.emplace_back(OptionGroup{title, {}});
}

std::vector<OptionGroup> option_groups(const CLI::App& app)
{
    const auto is_shown = [](const CLI::Option* option) { return !option->get_group().empty(); };
    std::vector<OptionGroup> groups;
    for (const CLI::Option* option : app.get_options(is_shown))
        if (option->get_positional())
            group_named(groups, "Files").options.push_back(described(*option));
    for (const CLI::Option* option : app.get_options(is_shown))
        if (!option->get_positional() && option->get_group() != "General")
            group_named(groups, option->get_group()).options.push_back(described(*option));
    for (const CLI::Option* option : app.get_options(is_shown))
        if (option->get_group() == "General")
            group_named(groups, "General").options.push_back(described(*option));
    return groups;
}

std::vector<OptionText> command_list(const CLI::App& app)
{
    std::vector<OptionText> list;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        list.push_back({command->get_name(), split(command->get_description(), "\n\n").front()});
    return list;
}

std::string synopsis(const CLI::App& app, const std::string& name, bool has_commands)
{
    if (has_commands)
        return name + " COMMAND [options]";
    std::string text = name;
    for (const CLI::Option* option : app.get_options())
        if (option->get_positional())
            text +=
                option->get_required() ? " " + option->get_name(true) : " [" + option->get_name(true) + "]";
    return text + " [options]";
}

HelpPage help_page(const CLI::App& app)
{
    HelpPage page;
    page.name = app.get_parent() ? app.get_parent()->get_name() + " " + app.get_name() : app.get_name();
    page.details = split(app.get_description(), "\n\n");
    page.summary = page.details.empty() ? "" : page.details.front();
    if (!page.details.empty())
        page.details.erase(page.details.begin());
    page.commands = command_list(app);
    page.synopsis = synopsis(app, page.name, !page.commands.empty());
    page.groups = option_groups(app);
    const std::vector<std::string> lines = split(app.get_footer(), "\n");
    for (std::size_t i = 0; i + 1 < lines.size(); i += 2)
        page.examples.push_back({lines[i], lines[i + 1]});
    return page;
}

// Words of `text` on lines of at most kTextWidth columns, all but the first indented; `column` is where the
// first starts.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t column)
{
    std::istringstream words(text);
    std::string result;
    for (std::string word; words >> word;) {
        if (column > indent && column + 1 + word.size() > kTextWidth) {
            result += "\n" + std::string(indent, ' ');
            column = indent;
        } else if (column > indent) {
            result += ' ';
            ++column;
        }
        result += word;
        column += word.size();
    }
    return result;
}

std::string as_row(const OptionText& option)
{
    const std::string left = "  " + option.names;
    const bool fits = left.size() + 2 <= kOptionIndent;
    const std::string gap =
        fits ? std::string(kOptionIndent - left.size(), ' ') : "\n" + std::string(kOptionIndent, ' ');
    return left + gap + wrapped(option.text, kOptionIndent, kOptionIndent) + "\n";
}

std::string as_text(const HelpPage& page)
{
    std::string text = page.name + ": " + page.summary + "\n\nUsage: " + page.synopsis + "\n";
    for (const std::string& paragraph : page.details)
        text += "\n" + wrapped(paragraph, 0, 0) + "\n";
    if (!page.commands.empty())
        text += "\nCommands:\n";
    for (const OptionText& command : page.commands)
        text += as_row(command);
    for (const OptionGroup& group : page.groups) {
        text += "\n" + group.title + ":\n";
        for (const OptionText& option : group.options)
            text += as_row(option);
    }
    if (!page.commands.empty()) {
        text += "\nEnvironment:\n";
        for (const auto& [name, meaning] : kEnvironment)
            text += as_row({std::string(name), std::string(meaning)});
    }
    if (!page.examples.empty())
        text += "\nExamples:\n";
    for (const Example& example : page.examples)
        text += "  # " + example.what + "\n  " + example.command_line + "\n";
    if (!page.commands.empty())
        text += fmt::format("\nSee '{} COMMAND --help' for the options of a command.\n", page.name);
    return text;
}

// Text as troff takes it: a hyphen that stays one, and no line that looks like a request.
std::string escaped(const std::string& text)
{
    std::string result;
    for (const char c : text) {
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
    }
    if (result.starts_with('.') || result.starts_with('\''))
        result.insert(0, "\\&");
    return result;
}

std::string tagged(const OptionText& item)
{
    return ".TP\n.B " + escaped(item.names) + "\n" + escaped(item.text) + "\n";
}

std::string page_name(const std::string& name)
{
    std::string result = name;
    std::ranges::replace(result, ' ', '-');
    return result;
}

std::string man_sections_at_the_end(const HelpPage& page)
{
    std::string text = ".SH EXIT STATUS\n";
    for (const auto& [code, meaning] : kExitCodes)
        text += tagged({std::string(code), std::string(meaning)});
    text += ".SH ENVIRONMENT\n";
    for (const auto& [name, meaning] : kEnvironment)
        text += tagged({std::string(name), std::string(meaning)});
    if (!page.examples.empty())
        text += ".SH EXAMPLES\n";
    for (const Example& example : page.examples)
        text += ".PP\n" + escaped(example.what) + ":\n.PP\n.nf\n.RS\n" + escaped(example.command_line)
                + "\n.RE\n.fi\n";
    return text;
}

std::string see_also(const CLI::App& app)
{
    const CLI::App& root = app.get_parent() ? *app.get_parent() : app;
    std::string text = ".SH SEE ALSO\n";
    if (&root != &app)
        text += ".BR " + escaped(root.get_name()) + " (1),\n";
    for (const CLI::App* command : root.get_subcommands([](const CLI::App*) { return true; }))
        if (command != &app)
            text += ".BR " + escaped(root.get_name() + "-" + command->get_name()) + " (1),\n";
    return text + ".BR gdalinfo (1)\n";
}

} // namespace

void add_details(CLI::App& app, std::string_view text)
{
    app.description(app.get_description() + "\n\n" + std::string(text));
}

void add_example(CLI::App& app, std::string_view what, std::string_view command_line)
{
    app.footer(app.get_footer() + std::string(what) + "\n" + std::string(command_line) + "\n");
}

std::string HelpText::make_help(const CLI::App* app, std::string, CLI::AppFormatMode) const
{
    return as_text(help_page(*app));
}

std::string man_page(const CLI::App& app)
{
    const HelpPage page = help_page(app);
    const std::string name = page_name(page.name);
    std::string title = name;
    std::ranges::transform(title, title.begin(),
                           [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    std::string text =
        fmt::format(".TH \"{}\" 1 \"\" \"Duskline {}\" \"Duskline manual\"\n", title, DUSKLINE_VERSION);
    text += ".SH NAME\n" + escaped(name) + " \\- " + escaped(page.summary) + "\n";
    text += ".SH SYNOPSIS\n.B " + escaped(page.synopsis) + "\n.SH DESCRIPTION\n";
    if (page.details.empty())
        text += escaped(page.name + ": " + page.summary + ".") + "\n";
    for (const std::string& paragraph : page.details)
        text += ".PP\n" + escaped(paragraph) + "\n";
    if (!page.commands.empty())
        text += ".SH COMMANDS\n";
    for (const OptionText& command : page.commands)
        text += tagged(command);
    text += ".SH OPTIONS\n";
    for (const OptionGroup& group : page.groups) {
        text += ".SS " + group.title + "\n";
        for (const OptionText& option : group.options)
            text += tagged(option);
    }
    return text + man_sections_at_the_end(page) + see_also(app);
}

} // namespace duskline::cli
