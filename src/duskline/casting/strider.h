#pragma once

#include <duskline/casting/light_frame.h>
#include <duskline/casting/shadow_mask.h>
#include <duskline/execution/progress.h>

#include <cstddef>
#include <vector>

namespace duskline {

/// Shadows cast down-light: from ground that stands in the light a line goes off along the light and marks what it
/// passes over, until it touches ground, from which the next one goes off. There is one track of such lines for
/// each cell of the edges where the light enters, one cell from the next, and every cell is on one track: none is
/// missed, and none is visited twice. A cell has the answer of the place on its track beside it, at most half a
/// cell from its centre, so edges of shadows lie off by up to that.
///
/// No data neither casts nor stops a line, and stays unknown; where a track passes between a sample and no data, or
/// the border, the sample counts alone. Same bytes for any number of threads. Throws InvalidInput for angles or cell
/// sizes out of range, Cancelled. Cost: O(cells), about twice that of `sweep`. See docs/algorithms/strider.md, and
/// GradualShadows for the same mask over several frames.
ShadowMask cast_by_strider(const HeightField& field, const DirectionalLight& light,
                           const Execution& execution = {});

/// How high those lines pass: over a cell's own ground by as much as over the ground on the track. `mask_of` them
/// is the mask.
ShadowField shadow_heights_by_strider(const HeightField& field, const DirectionalLight& light,
                                      const Execution& execution = {});

/// The lines of a strider that is fed in pieces: read some lines of the grid, nearest the light first, advance, and
/// the answers for them are final. Lines of the grid are rows or columns as the frame says, and come in light order,
/// every one once. However they are cut into pieces, the bytes are the same.
///
/// Memory: a float for each track (at most twice the cells of a line), and per thread some 600 KiB.
class StriderFront {
public:
    /// Before the first of `lines` lines of `cells` cells.
    StriderFront(std::size_t lines, std::size_t cells, const LightFrame& frame);

    /// Goes on over the next `heights.lines` lines and answers each of their cells. Both have `cells` cells a line;
    /// one of line step and cell step must be 1 or -1 (rows or columns of a grid). After Cancelled the front is of
    /// no more use.
    void advance(const LightOrder<const float>& heights, const LightOrder<Lit>& mask,
                 const Execution& execution);
    void advance(const LightOrder<const float>& heights, const LightOrder<float>& shadow_heights_m,
                 const Execution& execution);

private:
    template <typename Answer>
    void advance_tracks(const LightOrder<const float>& heights, const LightOrder<Answer>& answers,
                        const Execution& execution);

    LightFrame frame_;
    std::size_t cells_;
    std::size_t next_line_ = 0;
    std::ptrdiff_t first_track_; // the one whose line is line_m_[0]
    std::vector<float> line_m_;  // how high the line on each track passes; minus infinity where there is none
};

} // namespace duskline
