#pragma once

#include "cli11_names.h"

#include <duskline/casting/shadow_mask.h>
#include <duskline/geometry/grid.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace duskline::cli {

/// What a mask writes for each answer.
struct MaskCodes {
    std::uint8_t shadow = 0;
    std::uint8_t lit = 1;
    std::uint8_t no_data = 255;

    bool operator==(const MaskCodes&) const = default;
};

/// --shadow-value, --lit-value, --dst-nodata.
struct MaskCodeOptions {
    std::optional<std::uint8_t> shadow = {};
    std::optional<std::uint8_t> lit = {};
    std::optional<std::uint8_t> no_data = {};
};

/// `options` must outlive `app`'s parsing.
void add_mask_code_options(CLI::App& app, MaskCodeOptions& options);

/// The codes asked for; else 0, 1, 255, and for pictures, which people look at, 0, 255, 128. Throws UsageError
/// when two are the same.
MaskCodes choose_mask_codes(const MaskCodeOptions& options, bool picture);

/// "0 shadow, 1 lit, 255 no data".
std::string in_words(const MaskCodes& codes);

/// Puts the codes where the answers are.
void encode(GridView<Lit> mask, const MaskCodes& codes);

/// How many cells got which answer.
struct LitCount {
    std::size_t lit = 0;
    std::size_t shadow = 0;
    std::size_t partly_lit = 0; ///< of shares only
    std::size_t no_data = 0;

    std::size_t cells() const { return lit + shadow + partly_lit + no_data; }
};
void count_into(LitCount& count, GridView<const Lit> mask);

/// The same of shares from 0 to 1, NaN for no data.
void count_shares_into(LitCount& count, GridView<const float> shares);

} // namespace duskline::cli
