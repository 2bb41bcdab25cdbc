#pragma once
// Internal to tools/plot: appearance of the elements of a map, in the map and in the legend.

#include <Eigen/Core>

#include "tools/plot/canvas.hpp"
#include "tools/plot/map_picture.hpp"

namespace azimuth {

// Colours of Okabe and Ito, which stay distinct for every kind of colour vision. Truth is grey to be less prominent.
inline constexpr Colour kPaperColour{1.0, 1.0, 1.0};
inline constexpr Colour kInkColour{0.13, 0.14, 0.16};
inline constexpr Colour kFaintColour{0.40, 0.42, 0.45};
inline constexpr Colour kNameColour{0.25, 0.27, 0.30};
inline constexpr Colour kEstimateColour{0.0, 0.447, 0.698};
inline constexpr Colour kOdometryColour{0.835, 0.369, 0.0};
inline constexpr Colour kCalibratedColour{0.0, 0.62, 0.451};
inline constexpr Colour kSmoothedColour{0.8, 0.475, 0.655};
inline constexpr Colour kTruthColour{0.74, 0.76, 0.78};

inline constexpr double kTruthWidth_px = 9.0, kOdometryWidth_px = 2.0, kEstimateWidth_px = 2.6, kLostWidth_px = 1.6;
inline constexpr double kSmoothedWidth_px = 2.0;
inline constexpr double kLostDash_px = 9.0, kSmoothedDash_px = 14.0;
inline constexpr double kPlusRadius_px = 9.0, kRobotRadius_px = 22.0;

LandmarkStyle style_of(const MapPicture& picture, const PlottedLandmark& landmark);

/// The symbol of a true landmark.
void draw_plus(PlotCanvas& canvas, const Eigen::Vector2d& at_px);
/// The symbol of a landmark whose distance is hardly known.
void draw_hardly_known(PlotCanvas& canvas, const Eigen::Vector2d& at_px);
void draw_start(PlotCanvas& canvas, const Eigen::Vector2d& at_px);
/// An arrow head in the robot's heading. `direction` is in pixels, so y points down.
void draw_robot(PlotCanvas& canvas, const Eigen::Vector2d& at_px, const Eigen::Vector2d& direction);

}  // namespace azimuth
