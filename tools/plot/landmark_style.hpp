#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>

#include "tools/plot/canvas.hpp"

namespace azimuth {

/// A kind of landmark that the sensor distinguishes.
struct PlottedKind {
  std::string name;
  std::optional<double> hue_deg;  ///< hue of the real object: red 0, yellow 60, green 120, blue 240
};

enum class Marker { disc, square, triangle, diamond, pentagon, wedge };

/// Colour and shape together distinguish kinds, also for monochrome printers and colour-blind users.
struct LandmarkStyle {
  Colour colour;
  Marker marker = Marker::disc;
};

/// Style of landmarks of unknown kind.
LandmarkStyle plain_landmark_style();
/// Style of the kind with index `number` in a picture. The colours are those of Okabe and Ito, which stay distinct for
/// every kind of colour vision. The colour is the one nearest to the kind's hue; without a hue it follows from
/// `number`.
LandmarkStyle landmark_style(const PlottedKind& kind, std::size_t number);

void draw_marker(PlotCanvas& canvas, const Eigen::Vector2d& at_px, const LandmarkStyle& style);

/// Largest distance of any part of a marker from its centre.
inline constexpr double kMarkerRadius_px = 6.2;

}  // namespace azimuth
