#include <duskline/terrain/halved_grid.h>

#include <algorithm>
#include <cmath>

namespace duskline {

Grid<float> halved(GridView<const float> values)
{
    Grid<float> half((values.rows() + 1) / 2, (values.columns() + 1) / 2);
    for (std::size_t row = 0; row < half.rows(); ++row)
        for (std::size_t column = 0; column < half.columns(); ++column) {
            float sum = 0.0f;
            float count = 0.0f;
            for (std::size_t y = 2 * row; y < std::min(2 * row + 2, values.rows()); ++y)
                for (std::size_t x = 2 * column; x < std::min(2 * column + 2, values.columns()); ++x)
                    if (!std::isnan(values(y, x))) {
                        sum += values(y, x);
                        count += 1.0f;
                    }
            half(row, column) = sum / count; // 0 / 0 where there are no data
        }
    return half;
}

} // namespace duskline
