#include "command_line.h"

#include <gmock/gmock.h>

#include <regex>
#include <set>
#include <sstream>

namespace duskline::cli_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class CommandLineFrame : public CommandLineTest {
protected:
    // What --help lists.
    std::vector<std::string> commands() const
    {
        const std::string help = run({"--help"}).out;
        std::istringstream list(help.substr(help.find("Commands:\n")));
        std::vector<std::string> names;
        std::string line;
        for (std::getline(list, line); std::getline(list, line) && !line.empty();)
            if (std::string name; line[2] != ' ' && std::istringstream(line) >> name)
                names.push_back(name);
        EXPECT_GE(names.size(), 1U);
        return names;
    }
};

// Every --long-option in a text.
std::set<std::string> options_in(const std::string& text)
{
    const std::regex option("--[a-z][a-z-]+");
    return {std::sregex_token_iterator(text.begin(), text.end(), option), std::sregex_token_iterator()};
}

TEST_F(CommandLineFrame, SaysItsVersion)
{
    const Finished finished = run({"--version"});
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_EQ(finished.out, "duskline " DUSKLINE_VERSION "\n");
    EXPECT_EQ(finished.err, "");
}

TEST_F(CommandLineFrame, HelpGoesToStandardOutputAndListsTheCommands)
{
    const Finished finished = run({"--help"});
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_EQ(finished.err, "");
    EXPECT_THAT(finished.out, HasSubstr("Usage: duskline COMMAND [options]"));
    EXPECT_THAT(finished.out, HasSubstr("\n  sun "));
}

TEST_F(CommandLineFrame, HelpOfACommandShowsUnitsRangesAndDefaults)
{
    const Finished finished = run({"sun", "--help"});
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_THAT(finished.out, StartsWith("duskline sun: "));
    EXPECT_THAT(finished.out, HasSubstr("--time TIME"));
    EXPECT_THAT(finished.out, HasSubstr("Examples:"));
}

TEST_F(CommandLineFrame, HelpFitsEightyColumns)
{
    for (const std::string& command : commands()) {
        std::istringstream lines(run({command, "--help"}).out);
        for (std::string line; std::getline(lines, line);)
            EXPECT_TRUE(line.size() <= 80 || line.starts_with("  duskline ")) << command << ": " << line;
    }
}

TEST_F(CommandLineFrame, EveryCommandHasAnExample)
{
    for (const std::string& command : commands())
        EXPECT_THAT(run({command, "--help"}).out, HasSubstr("\n  duskline " + command + " ")) << command;
}

struct WrongUsage {
    Arguments arguments;
    const char* says;
};

void PrintTo(const WrongUsage& wrong, std::ostream* out)
{
    *out << "duskline";
    for (const std::string& argument : wrong.arguments)
        *out << ' ' << argument;
}

class CommandLineUsage : public CommandLineTest, public ::testing::WithParamInterface<WrongUsage> {};

TEST_P(CommandLineUsage, IsRefusedOnOneLineWithCode2)
{
    const Finished finished = run(GetParam().arguments);
    EXPECT_EQ(finished.exit_code, 2);
    EXPECT_TRUE(is_one_error_line(finished.err));
    EXPECT_THAT(finished.err, HasSubstr(GetParam().says));
    EXPECT_EQ(finished.out, "");
}

INSTANTIATE_TEST_SUITE_P(
    Wrong, CommandLineUsage,
    ::testing::Values(WrongUsage{{}, "give a command: "}, //
                      WrongUsage{{"shdow"}, "no command is called 'shdow'; there are: "},
                      WrongUsage{{"--verson"}, "no option is called '--verson' (see duskline --help)"},
                      WrongUsage{{"sun", "--tiem", "now"},
                                 "no option is called '--tiem' (see duskline sun --help)"},
                      WrongUsage{{"sun", "--time"}, "--time needs a value (see duskline sun --help)"},
                      WrongUsage{{"sun", "--at", "0,0", "--at", "1,1"}, "--at may be given once"},
                      WrongUsage{{"sun", "here", "there"}, "'there' is one argument too many"},
                      WrongUsage{{"sun", "--time=", "--at", "0,0"}, "--time '"},
                      WrongUsage{{"sun", "--json=perhaps", "--time", "2026-06-21T12:00Z"}, "json"}));

TEST_F(CommandLineFrame, ManualPagesNameEveryOptionOfTheHelp)
{
    for (const std::string& command : commands()) {
        std::string page = run({command, "--man-page"}).out;
        EXPECT_THAT(page, StartsWith(".TH \"DUSKLINE-"));
        EXPECT_THAT(page, HasSubstr(".SH EXIT STATUS"));
        EXPECT_THAT(page, HasSubstr(".SH EXAMPLES"));
        std::erase(page, '\\');
        EXPECT_EQ(options_in(page), options_in(run({command, "--help"}).out)) << command;
    }
}

TEST_F(CommandLineFrame, ManualPagesRenderWithoutComplaint)
{
    if (run_program({"sh", "-c", "command -v groff"}).exit_code != 0)
        GTEST_SKIP() << "groff is not installed";
    std::vector<std::string> pages = commands();
    pages.emplace_back();
    for (const std::string& command : pages) {
        const Finished finished = run_program(
            {"sh", "-c", "\"$DUSKLINE\" " + command + " --man-page | groff -man -Tutf8 -P-cbou -ww"});
        EXPECT_EQ(finished.exit_code, 0) << command;
        EXPECT_EQ(finished.err, "") << command;
        EXPECT_THAT(finished.out, HasSubstr("EXIT STATUS")) << command;
    }
}

TEST_F(CommandLineFrame, AFullStandardOutputIsAnError)
{
    const Finished finished = run_program({"sh", "-c", "\"$DUSKLINE\" --help > /dev/full"});
    EXPECT_EQ(finished.exit_code, 4);
    EXPECT_TRUE(is_one_error_line(finished.err));
}

} // namespace
} // namespace duskline::cli_test
