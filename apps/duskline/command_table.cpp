#include "command.h"

#include <array>

namespace duskline::cli {

Run declare_bench(CLI::App& app);
Run declare_day(CLI::App& app);
Run declare_hours(CLI::App& app);
Run declare_info(CLI::App& app);
Run declare_light(CLI::App& app);
Run declare_relief(CLI::App& app);
Run declare_shadow(CLI::App& app);
Run declare_sun(CLI::App& app);

std::span<const Command> commands()
{
    static constexpr std::array kCommands = {
        Command{"shadow", "which cells are in the light, and which in the shadow of others", declare_shadow},
        Command{"day", "maps of light or shadows over a day, to swap or cross-fade", declare_day},
        Command{"hours", "how long the sun shines on each cell, in a day or a year", declare_hours},
        Command{"relief", "a picture of the terrain: colours by height, light, shadows", declare_relief},
        Command{"light", "how much light falls on every cell, shadows included: light maps", declare_light},
        Command{"bench", "how fast and how right the casters are on your terrain", declare_bench},
        Command{"sun", "where the sun is, and when it rises and sets", declare_sun},
        Command{"info", "what Duskline understands of a file", declare_info},
    };
    return kCommands;
}

} // namespace duskline::cli
