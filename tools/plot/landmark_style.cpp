#include "tools/plot/landmark_style.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

struct NamedHue {
  double hue_deg;
  Colour colour;
};

constexpr Colour kBluishGreen{0.0, 0.62, 0.451};
constexpr std::array kPalette{NamedHue{140.0, kBluishGreen},         NamedHue{310.0, {0.8, 0.475, 0.655}},
                              NamedHue{35.0, {0.902, 0.624, 0.0}},   NamedHue{190.0, {0.337, 0.706, 0.914}},
                              NamedHue{56.0, {0.941, 0.894, 0.259}}, NamedHue{0.0, {0.835, 0.369, 0.0}},
                              NamedHue{235.0, {0.0, 0.447, 0.698}}};
constexpr Colour kMarkerEdge{0.13, 0.14, 0.16};

double hue_distance_deg(double a, double b) { return std::abs(std::remainder(a - b, 360.0)); }

Colour colour_of(const PlottedKind& kind, std::size_t number) {
  if (!kind.hue_deg) return kPalette[number % kPalette.size()].colour;
  const double hue_deg = *kind.hue_deg;
  return std::ranges::min_element(
             kPalette, {},
             [hue_deg](const NamedHue& candidate) { return hue_distance_deg(candidate.hue_deg, hue_deg); })
      ->colour;
}

/// Corners of a regular polygon, the first one at angle `first_rad` (0: to the right, counter-clockwise).
std::vector<Eigen::Vector2d> regular(const Eigen::Vector2d& middle, int corners, double first_rad, double radius_px) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = first_rad + 2.0 * kPi * i / corners;
    points.emplace_back(middle + radius_px * Eigen::Vector2d{std::cos(angle), -std::sin(angle)});
  }
  return points;
}

std::vector<Eigen::Vector2d> outline(Marker marker, const Eigen::Vector2d& at_px) {
  switch (marker) {
    case Marker::disc:
      return regular(at_px, 16, 0.0, 4.2);
    case Marker::square:
      return regular(at_px, 4, kPi / 4, 5.4);
    case Marker::triangle:
      return regular(at_px, 3, kPi / 2, kMarkerRadius_px);
    case Marker::diamond:
      return regular(at_px, 4, 0.0, kMarkerRadius_px);
    case Marker::pentagon:
      return regular(at_px, 5, kPi / 2, 5.6);
    case Marker::wedge:
      return regular(at_px, 3, -kPi / 2, kMarkerRadius_px);
  }
  return {};
}

}  // namespace

LandmarkStyle plain_landmark_style() { return {kBluishGreen, Marker::disc}; }

LandmarkStyle landmark_style(const PlottedKind& kind, std::size_t number) {
  constexpr std::array kMarkers{Marker::disc,    Marker::square,   Marker::triangle,
                                Marker::diamond, Marker::pentagon, Marker::wedge};
  return {colour_of(kind, number), kMarkers[number % kMarkers.size()]};
}

void draw_marker(PlotCanvas& canvas, const Eigen::Vector2d& at_px, const LandmarkStyle& style) {
  canvas.polygon(outline(style.marker, at_px), style.colour, kMarkerEdge, 1.0);
}

}  // namespace azimuth
