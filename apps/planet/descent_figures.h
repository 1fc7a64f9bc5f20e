#pragma once

#include "planet_frame.h"
#include "shadow_truth.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace duskline::planet_app {

/// Heights over the ground whose frames are reported by themselves.
inline constexpr std::size_t kDescentBands = 7;

/// Which one a clearance falls into, 0 the lowest.
std::size_t descent_band(double clearance_m);

template <typename T>
using OfBands = std::array<T, kDescentBands>;

/// Milliseconds of frames, of each band.
class FrameTimes {
public:
    void note(std::size_t band, double ms) { bands_.at(band).push_back(ms); }

    /// Median, 99th percentile and mean of a band; without one, of all frames. There must be a frame.
    nlohmann::ordered_json as_json(std::optional<std::size_t> band = {}) const;

    std::size_t frames(std::size_t band) const { return bands_.at(band).size(); }
    std::vector<double> all() const;

private:
    OfBands<std::vector<double>> bands_;
};

/// What one technique took, and got wrong, on a way down.
class DescentFigures {
public:
    explicit DescentFigures(std::string technique) : technique_(std::move(technique)) {}

    /// The next frame, and the same drawn without shadows where somebody did.
    void note(std::size_t band, const FrameCost& cost, const FrameCost* without_shadows);

    void note(std::size_t band, const ShadowErrors& errors) { errors_.at(band) += errors; }

    /// Times of frames, of finding shadows, of drawing, and of both less those without shadows; errors; of all frames and of each
    /// band that frames fell into.
    nlohmann::ordered_json as_json() const;

private:
    nlohmann::ordered_json times_as_json(std::optional<std::size_t> band) const;

    std::string technique_;
    FrameTimes frame_ms_;
    FrameTimes cast_ms_;
    FrameTimes draw_ms_;
    FrameTimes shadow_ms_;
    bool compared_ = false; ///< with frames without shadows
    double triangles_ = 0.0;
    double settled_ = 0.0; ///< frames in which all was there that the view wants
    OfBands<ShadowErrors> errors_;
};

/// The bands that frames fell into, with how many and what loading took in them.
nlohmann::ordered_json bands_as_json(const FrameTimes& load_ms);

} // namespace duskline::planet_app
