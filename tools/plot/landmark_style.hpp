#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>

#include "tools/plot/canvas.hpp"

namespace azimuth {

/// A sort of landmark, as far as the sensor tells sorts.
struct PlottedKind {
  std::string name;
  std::optional<double> hue_deg;  ///< of the thing itself: red 0, yellow 60, green 120, blue 240
};

enum class Marker { disc, square, triangle, diamond, pentagon, wedge };

/// Colour and shape together tell kinds apart, so that neither a printer nor an eye needs all colours.
struct LandmarkStyle {
  Colour colour;
  Marker marker = Marker::disc;
};

/// Landmarks of no known kind.
LandmarkStyle plain_landmark_style();
/// Of the kind with this number among all of a picture. Colours are those of Okabe and Ito, told apart by every kind of
/// colour vision: the one nearest to the kind's own hue, else the next one.
LandmarkStyle landmark_style(const PlottedKind& kind, std::size_t number);

void draw_marker(PlotCanvas& canvas, const Eigen::Vector2d& at_px, const LandmarkStyle& style);

/// A marker reaches no farther than this from its middle.
inline constexpr double kMarkerRadius_px = 6.2;

}  // namespace azimuth
