#include <duskline/raster_io/plain_number.h>

#include <array>
#include <cmath>
#include <cstdio>

namespace duskline {

std::string plain_number(double value, int decimals)
{
    std::array<char, 64> text{};
    if (!std::isfinite(value) || std::abs(value) >= 1e15)
        std::snprintf(text.data(), text.size(), "%.6g", value);
    else
        std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    std::string number = text.data();
    if (number.find('.') != std::string::npos && number.find('e') == std::string::npos) {
        number.erase(number.find_last_not_of('0') + 1);
        if (number.back() == '.')
            number.pop_back();
    }
    return number == "-0" ? "0" : number;
}

} // namespace duskline
