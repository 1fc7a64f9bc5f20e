#include "descent_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace duskline::planet_app {
namespace {

struct Band {
    const char* name;
    double below_m;
};
constexpr OfBands<Band> kBands = {{{"below 50 m", 50.0},
                                   {"50 to 200 m", 200.0},
                                   {"200 m to 1 km", 1e3},
                                   {"1 to 10 km", 1e4},
                                   {"10 to 100 km", 1e5},
                                   {"100 to 1000 km", 1e6},
                                   {"above 1000 km", std::numeric_limits<double>::infinity()}}};

// The value below which that share of them lies.
double at_share(const std::vector<double>& sorted, double share)
{
    return sorted[static_cast<std::size_t>(std::lround(share * static_cast<double>(sorted.size() - 1)))];
}

double mean(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

nlohmann::ordered_json as_json(const ShadowErrors& errors)
{
    const auto pixels = static_cast<double>(errors.pixels);
    return {{"pixels", errors.pixels},
            {"wrong_share", static_cast<double>(errors.wrong) / pixels},
            {"wrong_apart_share", static_cast<double>(errors.wrong_apart) / pixels}};
}

} // namespace

std::size_t descent_band(double clearance_m)
{
    const auto band = std::ranges::find_if(kBands, [&](const Band& it) { return clearance_m < it.below_m; });
    return static_cast<std::size_t>(band - kBands.begin());
}

std::vector<double> FrameTimes::all() const
{
    std::vector<double> all;
    for (const std::vector<double>& band : bands_)
        all.insert(all.end(), band.begin(), band.end());
    return all;
}

nlohmann::ordered_json FrameTimes::as_json(std::optional<std::size_t> band) const
{
    std::vector<double> ms = band ? bands_.at(*band) : all();
    std::ranges::sort(ms);
    return {{"median", at_share(ms, 0.5)}, {"p99", at_share(ms, 0.99)}, {"mean", mean(ms)}};
}

void DescentFigures::note(std::size_t band, const FrameCost& cost, const FrameCost* without_shadows)
{
    frame_ms_.note(band, cost.frame_ms());
    cast_ms_.note(band, cost.cast_ms);
    draw_ms_.note(band, cost.draw_ms);
    compared_ = without_shadows != nullptr;
    if (compared_)
        shadow_ms_.note(band, cost.frame_ms() - without_shadows->frame_ms());
    triangles_ += static_cast<double>(cost.drawn.triangles);
    settled_ += cost.settled ? 1.0 : 0.0;
}

nlohmann::ordered_json DescentFigures::times_as_json(std::optional<std::size_t> band) const
{
    nlohmann::ordered_json json = {{"frame_ms", frame_ms_.as_json(band)},
                                   {"cast_ms", cast_ms_.as_json(band)},
                                   {"draw_ms", draw_ms_.as_json(band)}};
    if (compared_)
        json["shadow_ms"] = shadow_ms_.as_json(band);
    return json;
}

nlohmann::ordered_json DescentFigures::as_json() const
{
    const std::vector<double> frame_ms = frame_ms_.all();
    const auto frames = static_cast<double>(frame_ms.size());
    const auto [shortest, longest] = std::ranges::minmax(frame_ms);
    nlohmann::ordered_json json = {
        {"technique", technique_},
        {"frames", frame_ms.size()},
        {"fps",
         {{"least", 1000.0 / longest}, {"most", 1000.0 / shortest}, {"mean", 1000.0 / mean(frame_ms)}}},
        {"mean_triangles", triangles_ / frames},
        {"settled_share", settled_ / frames}};
    json.update(times_as_json({}));
    nlohmann::ordered_json bands = nlohmann::ordered_json::array();
    ShadowErrors all;
    for (std::size_t band = 0; band < kDescentBands; ++band) {
        all += errors_.at(band);
        if (frame_ms_.frames(band) == 0)
            continue;
        nlohmann::ordered_json figures = {{"band", kBands.at(band).name}, {"frames", frame_ms_.frames(band)}};
        figures.update(times_as_json(band));
        if (errors_.at(band).pixels > 0)
            figures["errors"] = planet_app::as_json(errors_.at(band));
        bands.push_back(figures);
    }
    if (all.pixels > 0)
        json["errors"] = planet_app::as_json(all);
    json["bands"] = bands;
    return json;
}

nlohmann::ordered_json bands_as_json(const FrameTimes& load_ms)
{
    nlohmann::ordered_json bands = nlohmann::ordered_json::array();
    for (std::size_t band = 0; band < kDescentBands; ++band)
        if (load_ms.frames(band) > 0)
            bands.push_back({{"band", kBands.at(band).name},
                             {"frames", load_ms.frames(band)},
                             {"load_ms", load_ms.as_json(band)}});
    return bands;
}

} // namespace duskline::planet_app
