#pragma once

#include "height_input.h"
#include "light_options.h"
#include "viewer_state.h"

#include <duskline/light/directional_light.h>
#include <duskline/light/light_course.h>
#include <duskline/light/place.h>

#include <optional>

namespace duskline::viewer {

/// Turns a state's light into one for the grid, and knows the sun of the place where there is one.
class SunClock {
public:
    /// `at` replaces the raster's centre.
    SunClock(const cli::LightSite& site, const cli::SunlightOptions& options,
             std::optional<double> sun_size_deg);

    /// Whether times mean anything here: on the Earth, at a known place.
    bool knows_times() const { return place_.has_value(); }

    /// Sets the angles from the time, if the light has one.
    void bring_up_to_date(ViewerLight& light) const;

    /// The light as casters take it: azimuth from the grid's north.
    DirectionalLight on_grid(const ViewerLight& light) const;

    /// The way of a light, in so many steps: by its time the day's sun, from sunrise to sunset (or from midnight to midnight
    /// where it does neither), in even steps of time; without one once round the compass.
    LightCourse course(const ViewerLight& light, std::size_t lights) const;

private:
    LightCourse day_course(const DateTime& time, std::size_t lights) const;

    cli::LightSite site_;
    Air air_;
    std::optional<Place> place_;
    Angle sun_size_;
};

/// A light as if dragged over the sky by pixels of a picture so high: to the right moves it clockwise, up higher.
/// Altitudes stay from -5 to 90 degrees.
ViewerLight dragged(const ViewerLight& light, double right_px, double up_px, double picture_height_px);

} // namespace duskline::viewer
