#include <duskline/products/palette.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace duskline {

Palette::Palette() : entries_{{0.0, colour_from_srgb(200.0, 200.0, 200.0), 1.0f}} {}

Palette::Palette(std::vector<Entry> entries) : entries_(std::move(entries))
{
    if (entries_.empty())
        throw InvalidInput("a palette must have at least one entry, got none");
    for (const Entry& entry : entries_)
        if (std::isnan(entry.height_m))
            throw InvalidInput("the heights of a palette must be numbers, got NaN");
    std::stable_sort(entries_.begin(), entries_.end(),
                     [](const Entry& a, const Entry& b) { return a.height_m < b.height_m; });
}

Palette::Entry Palette::at(float height_m) const
{
    const auto above = std::upper_bound(entries_.begin(), entries_.end(), height_m,
                                        [](float h, const Entry& entry) { return h < entry.height_m; });
    if (above == entries_.begin())
        return entries_.front();
    const auto below = above - 1;
    if (above == entries_.end())
        return entries_.back();
    const auto t = static_cast<float>((height_m - below->height_m) / (above->height_m - below->height_m));
    return {height_m, mix(below->colour, above->colour, t),
            below->opacity + (above->opacity - below->opacity) * t};
}

namespace {

// Bytes of sRGB from one step of a text's palette to the next: so close that linear in light is linear in
// sRGB.
constexpr double kBytesPerStep = 4.0;

struct NamedColour {
    std::string_view name;
    std::uint32_t rgb;
};

// The names that gdaldem knows.
constexpr std::array<NamedColour, 16> kNamedColours = {{
    {"white", 0xFFFFFF},
    {"black", 0x000000},
    {"red", 0xFF0000},
    {"green", 0x00FF00},
    {"blue", 0x0000FF},
    {"yellow", 0xFFFF00},
    {"magenta", 0xFF00FF},
    {"cyan", 0x00FFFF},
    {"aqua", 0x00BFBF},
    {"grey", 0xBFBFBF},
    {"gray", 0xBFBFBF},
    {"orange", 0xFF7F00},
    {"brown", 0xBF7F3F},
    {"purple", 0x7F00FF},
    {"violet", 0x7F00FF},
    {"indigo", 0x007FFF},
}};

// One line of a text: where, and sRGB and opacity from 0 to 255.
struct TextEntry {
    double height_m = 0.0;
    bool is_no_data = false;
    std::array<double, 4> rgba = {0.0, 0.0, 0.0, 255.0};
};

[[noreturn]] void refuse(std::size_t line, std::string_view text, const std::string& right)
{
    throw InvalidInput("line " + std::to_string(line) + " of the palette: '" + std::string(text) + "' is not "
                       + right);
}

std::string lower_case(std::string_view text)
{
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) {
        return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    });
    return result;
}

std::vector<std::string> words_of(std::string_view line)
{
    constexpr std::string_view separators = " \t,:\r";
    line = line.substr(0, line.find('#'));
    std::vector<std::string> words;
    for (std::size_t begin = line.find_first_not_of(separators); begin != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
        words.push_back(lower_case(line.substr(begin, end - begin)));
        begin = line.find_first_not_of(separators, end);
    }
    return words;
}

std::optional<double> number_in(std::string_view word)
{
    if (word.starts_with('+'))
        word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::array<double, 4> colour_in(const std::vector<std::string>& words, std::size_t line)
{
    if (words.size() == 2) {
        const auto named = std::find_if(kNamedColours.begin(), kNamedColours.end(),
                                        [&](const NamedColour& c) { return c.name == words[1]; });
        if (named == kNamedColours.end())
            refuse(line, words[1], "a colour's name: give red, green and blue from 0 to 255");
        return {static_cast<double>(named->rgb >> 16 & 255U), static_cast<double>(named->rgb >> 8 & 255U),
                static_cast<double>(named->rgb & 255U), 255.0};
    }
    if (words.size() != 4 && words.size() != 5)
        refuse(line, std::to_string(words.size()) + " words",
               "an entry: give a height, red, green, blue and perhaps opacity");
    std::array<double, 4> rgba = {0.0, 0.0, 0.0, 255.0};
    for (std::size_t i = 1; i < words.size(); ++i) {
        const auto value = number_in(words[i]);
        if (!value || !(*value >= 0.0 && *value <= 255.0))
            refuse(line, words[i], "a number from 0 to 255");
        rgba[i - 1] = *value;
    }
    return rgba;
}

TextEntry entry_in(const std::vector<std::string>& words, std::size_t line, double lowest_m, double highest_m)
{
    TextEntry entry;
    entry.rgba = colour_in(words, line);
    if (words[0] == "nv") {
        entry.is_no_data = true;
        return entry;
    }
    const bool percent = words[0].ends_with('%');
    const auto value =
        number_in(percent ? std::string_view(words[0]).substr(0, words[0].size() - 1) : words[0]);
    if (!value)
        refuse(line, words[0], "a height in metres, a percentage, or nv");
    entry.height_m = percent ? lowest_m + *value / 100.0 * (highest_m - lowest_m) : *value;
    return entry;
}

Palette::Entry entry_of(const TextEntry& e)
{
    return {e.height_m, colour_from_srgb(e.rgba[0], e.rgba[1], e.rgba[2]),
            static_cast<float>(e.rgba[3] / 255.0)};
}

Rgba8 pixel_of(const TextEntry& e)
{
    Rgba8 pixel;
    std::transform(e.rgba.begin(), e.rgba.end(), pixel.begin(),
                   [](double value) { return static_cast<std::uint8_t>(std::lround(value)); });
    return pixel;
}

int steps_between(const TextEntry& a, const TextEntry& b)
{
    double most = 0.0;
    for (std::size_t k = 0; k < 4; ++k)
        most = std::max(most, std::abs(b.rgba[k] - a.rgba[k]));
    return std::max(1, static_cast<int>(std::ceil(most / kBytesPerStep)));
}

TextEntry between(const TextEntry& a, const TextEntry& b, double t)
{
    TextEntry result = a;
    result.height_m = std::lerp(a.height_m, b.height_m, t);
    for (std::size_t k = 0; k < 4; ++k)
        result.rgba[k] = std::lerp(a.rgba[k], b.rgba[k], t);
    return result;
}

// All entries, with steps in between that follow the straight line in sRGB.
std::vector<Palette::Entry> with_steps(std::vector<TextEntry> text_entries)
{
    std::stable_sort(text_entries.begin(), text_entries.end(),
                     [](const TextEntry& a, const TextEntry& b) { return a.height_m < b.height_m; });
    std::vector<Palette::Entry> entries = {entry_of(text_entries.front())};
    for (std::size_t i = 1; i < text_entries.size(); ++i) {
        const TextEntry& from = text_entries[i - 1];
        const TextEntry& to = text_entries[i];
        const int steps = from.height_m < to.height_m ? steps_between(from, to) : 1;
        for (int step = 1; step < steps; ++step)
            entries.push_back(entry_of(between(from, to, static_cast<double>(step) / steps)));
        entries.push_back(entry_of(to));
    }
    return entries;
}

} // namespace

Palette palette_from_text(std::string_view text, double lowest_m, double highest_m)
{
    std::vector<TextEntry> entries;
    std::optional<Rgba8> no_data;
    for (std::size_t line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const auto words = words_of(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (words.empty())
            continue;
        const TextEntry entry = entry_in(words, line, lowest_m, highest_m);
        if (entry.is_no_data)
            no_data = pixel_of(entry);
        else
            entries.push_back(entry);
    }
    if (entries.empty())
        throw InvalidInput("the palette has no entries: give lines of height, red, green, blue");
    Palette palette(with_steps(std::move(entries)));
    palette.no_data = no_data;
    return palette;
}

} // namespace duskline
