#include "tools/plot/map_strokes.hpp"

#include <array>

namespace azimuth {

LandmarkStyle style_of(const MapPicture& picture, const PlottedLandmark& landmark) {
  const auto number = static_cast<std::size_t>(landmark.kind);
  if (landmark.kind < 0 || number >= picture.kinds.size()) return plain_landmark_style();
  return landmark_style(picture.kinds[number], number);
}

void draw_plus(PlotCanvas& canvas, const Eigen::Vector2d& at_px) {
  const Eigen::Vector2d right{kPlusRadius_px, 0.0}, up{0.0, kPlusRadius_px};
  canvas.line(std::array<Eigen::Vector2d, 2>{at_px - right, at_px + right}, kInkColour, 1.8);
  canvas.line(std::array<Eigen::Vector2d, 2>{at_px - up, at_px + up}, kInkColour, 1.8);
}

void draw_hardly_known(PlotCanvas& canvas, const Eigen::Vector2d& at_px) { canvas.ring(at_px, 5.5, kFaintColour, 1.5); }

void draw_start(PlotCanvas& canvas, const Eigen::Vector2d& at_px) {
  canvas.disc(at_px, 9.0, kPaperColour);
  canvas.disc(at_px, 6.5, kEstimateColour);
}

void draw_robot(PlotCanvas& canvas, const Eigen::Vector2d& at_px, const Eigen::Vector2d& direction) {
  const Eigen::Vector2d side{-direction.y(), direction.x()};
  canvas.polygon(std::array<Eigen::Vector2d, 4>{{at_px + 20.0 * direction, at_px - 13.0 * direction + 13.0 * side,
                                                 at_px - 6.0 * direction, at_px - 13.0 * direction - 13.0 * side}},
                 kEstimateColour, kPaperColour, 2.0);
}

}  // namespace azimuth
