#include "shadow_codes.h"

#include "exit_code.h"
#include "option_values.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace duskline::cli {
namespace {

void add_code(CLI::App& app, const std::string& name, const std::string& text,
              std::optional<std::uint8_t>& value)
{
    const auto read = [name, &value](const std::string& typed) {
        const std::size_t code = parse_count(name, typed, 0);
        if (code > 255)
            throw UsageError(fmt::format("{} must be from 0 to 255, got {}", name, code));
        value = static_cast<std::uint8_t>(code);
    };
    app.add_option_function<std::string>(name, read, text)->type_name("N")->group("Output");
}

std::size_t count_of(std::span<const Lit> row, Lit answer)
{
    std::size_t count = 0;
    for (const Lit lit : row)
        count += lit == answer ? 1U : 0U;
    return count;
}

} // namespace

void add_mask_code_options(CLI::App& app, MaskCodeOptions& options)
{
    add_code(app, "--shadow-value", "what a mask says in the shadow, 0 to 255; else 0", options.shadow);
    add_code(app, "--lit-value", "what it says in the light; else 1, in pictures (PNG, JPEG) 255",
             options.lit);
    add_code(app, "--dst-nodata", "what it says where there is no data; else 255, in pictures 128",
             options.no_data);
}

MaskCodes choose_mask_codes(const MaskCodeOptions& options, bool picture)
{
    MaskCodes codes = picture ? MaskCodes{.shadow = 0, .lit = 255, .no_data = 128} : MaskCodes{};
    codes.shadow = options.shadow.value_or(codes.shadow);
    codes.lit = options.lit.value_or(codes.lit);
    codes.no_data = options.no_data.value_or(codes.no_data);
    if (codes.shadow == codes.lit || codes.lit == codes.no_data || codes.shadow == codes.no_data)
        throw UsageError(
            fmt::format("the values of a mask must be three different ones, got {}", in_words(codes)));
    return codes;
}

std::string in_words(const MaskCodes& codes)
{
    return fmt::format("{} shadow, {} lit, {} no data", codes.shadow, codes.lit, codes.no_data);
}

void encode(GridView<Lit> mask, const MaskCodes& codes)
{
    if (codes == MaskCodes{})
        return;
    const auto code_of = [&codes](Lit lit) {
        const std::uint8_t code = lit == Lit::no ? codes.shadow : lit == Lit::yes ? codes.lit : codes.no_data;
        return static_cast<Lit>(code);
    };
    for (std::size_t y = 0; y < mask.rows(); ++y)
        std::ranges::transform(mask.row(y), mask.row(y).begin(), code_of);
}

void count_into(LitCount& count, GridView<const Lit> mask)
{
    for (std::size_t y = 0; y < mask.rows(); ++y) {
        const std::size_t lit = count_of(mask.row(y), Lit::yes);
        const std::size_t unknown = count_of(mask.row(y), Lit::unknown);
        count.lit += lit;
        count.no_data += unknown;
        count.shadow += mask.columns() - lit - unknown;
    }
}

void count_shares_into(LitCount& count, GridView<const float> shares)
{
    for (std::size_t y = 0; y < shares.rows(); ++y)
        for (const float share : shares.row(y)) {
            count.no_data += std::isnan(share) ? 1U : 0U;
            count.lit += share == 1.0f ? 1U : 0U;
            count.shadow += share == 0.0f ? 1U : 0U;
            count.partly_lit += share > 0.0f && share < 1.0f ? 1U : 0U;
        }
}

} // namespace duskline::cli
