#include "command.h"

#include <array>

namespace duskline::cli {

Run declare_sun(CLI::App& app);

std::span<const Command> commands()
{
    static constexpr std::array kCommands = {
        Command{"sun", "where the sun is, and when it rises and sets", declare_sun},
    };
    return kCommands;
}

} // namespace duskline::cli
