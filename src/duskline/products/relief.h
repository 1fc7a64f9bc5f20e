#pragma once

#include <duskline/execution/progress.h>
#include <duskline/light/directional_light.h>
#include <duskline/products/lit_fraction.h>
#include <duskline/products/tint.h>
#include <duskline/terrain/earth_curvature.h>
#include <duskline/terrain/height_field.h>

#include <optional>

namespace duskline {

/// What a relief is to look like.
struct ReliefOptions {
    /// The ground's own colours.
    Tint tint = {};

    /// Colours that take the tint's place wherever they are opaque; empty, or of the terrain's size.
    GridView<const Rgba8> texture = {};

    /// Slopes are made that many times steeper before they are lit; above 0. Shadows are not: they stay where
    /// they fall. Not set: what `shading_exaggeration` finds.
    std::optional<double> exaggeration = std::nullopt;

    /// How bright level ground in shadow is, 1 being level ground in the light; 0 to below 1.
    double ambient = 0.28;

    /// How level ground tilts away from the light with distance, as shadows see it; `coefficient` 0 is flat.
    EarthCurvature curvature = {.coefficient = 0.0};

    /// A blue sky and a sun that reddens as it sinks; without air both are white.
    bool air = true;
};

/// How much steeper slopes must be for the light to show the form of a terrain: such that level ground and
/// ground of typical slope (the root mean square along the light) differ by 0.55 of level ground's light;
/// from 1 to 6. The sea and other ground without any slope does not count. Looks at about a million cells.
double shading_exaggeration(const HeightField& field, const DirectionalLight& light);

/// A picture of the terrain from above: ground colours, lit by the light and by the sky, with cast shadows.
///
/// For every cell, in linear light, per colour channel:
///
///     pixel = soft_clip(ground (ambient sky S + (1 - ambient) sun D lit))
///
///   D    light on the slope over light on level ground, r = n.l / sin(altitude), passed through
///        2.6 r / (1.6 + r), which keeps 0 and 1 and bends what is brighter: the response of the eye (Naka
///        and Rushton 1966; in pictures: Reinhard et al., Photographic tone reproduction, 2002)
///   n    the upward normal of Horn's slopes (normals.h), made `exaggeration` times as steep, and tilted with
///        the curvature of the globe
///   l    the direction towards the light
///   lit  the lit fraction: cast shadows, with edges drawn within cells if it comes from shadow heights
///   S    light of the sky on the slope, 1 on level open ground: two fifths from all of the sky alike,
///        (1 + n_z) / 2, the rest from its brighter side 55 degrees high over the light's azimuth, as
///        ((1 + cos) / 2)^2; up to 38 % less where the ground is hollow, more where it stands out (its height
///        against means over 4, 8, 16 and 32 cells). It gives form to what lies in shadow.
///   sun, sky  colours of luminance 1 (daylight.h); white without air
///   soft_clip the identity up to 0.65 (sRGB 211 of 255), from there on bending towards 1
///
/// So level ground in the light shows its own colour, exactly so with the sun at 45 degrees or without air,
/// and in shadow `ambient` of it. A picture is exposed for its light: a low sun makes it no darker, but
/// slopes stand out more.
///
/// Water (`SeaKind::surface`) lies level; see level_water.h for its colours. A light at or below the horizon
/// leaves the light of the sky. Cells without data get the palette's pixel for them, else transparent black;
/// a lit fraction of NaN elsewhere counts as lit. Bytes are dithered (colour.h) and the same for any number
/// of threads.
///
/// Throws InvalidInput for sizes that differ and options out of range, Cancelled. Some 90 nanoseconds a cell
/// on one thread; 4 bytes a cell besides the picture where there is water.
Picture relief(const HeightField& field, const DirectionalLight& light, const LitFraction& lit,
               const ReliefOptions& options = {}, const Execution& execution = {});

} // namespace duskline
