#include <duskline/casting/light_frame.h>

#include <cmath>

namespace duskline {

LightFrame light_frame(const DirectionalLight& light, CellSize cell_size_m)
{
    // Away from the light, in cells per metre of ground: columns count eastwards, rows southwards.
    const auto [sine, cosine] = sine_cosine(light.azimuth);
    const double columns = -sine / cell_size_m.x;
    const double rows = cosine / cell_size_m.y;

    LightFrame frame;
    // On a diagonal either would do; taken in turn around the compass, so that quarter turns agree.
    frame.lines_are_rows = std::abs(rows) > std::abs(columns)
                           || (std::abs(rows) == std::abs(columns) && (rows > 0.0) == (columns > 0.0));
    const double along = frame.lines_are_rows ? rows : columns;
    const double across = frame.lines_are_rows ? columns : rows;
    frame.first_line_is_index_0 = along > 0.0;
    frame.lateral = across / std::abs(along);
    if (std::abs(frame.lateral) < 1e-6)
        frame.lateral = 0.0;
    frame.drop_m = tangent(light.altitude) / std::abs(along);
    return frame;
}

} // namespace duskline
