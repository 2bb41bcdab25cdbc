#include "tools/plot/map_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <span>

namespace azimuth {
namespace {

/// Extent of the reliable path: truth, otherwise the estimate without lost pieces.
Extent trusted_extent(const MapPicture& picture) {
  Extent trusted;
  for (const PlotLine& piece : picture.truth) trusted.include(piece);
  trusted.include(picture.true_landmarks);
  if (!trusted.empty) return trusted;
  for (const PathPiece& piece : picture.estimate)
    if (!piece.lost) trusted.include(piece.line);
  return trusted;
}

/// Extent of the landmarks around `trusted` whose uncertainty is small relative to its size. Distant landmarks stay
/// outside, so that the view has no large empty areas.
Extent known_landmarks(const MapPicture& picture, const Extent& trusted) {
  constexpr double kCertain = 0.2, kReach = 0.6;
  const double size_m = trusted.empty ? 0.0 : trusted.size_m().maxCoeff();
  const Extent reach = trusted.padded(kReach * size_m);
  Extent extent;
  for (const PlottedLandmark& landmark : picture.landmarks)
    if (landmark.is_known && semi_major_m(landmark.point) < kCertain * size_m &&
        Box{reach.low_m, reach.high_m}.contains(landmark.point.p_map_m))
      extent.include(landmark.point.p_map_m);
  return extent;
}

std::size_t outside(std::span<const Eigen::Vector2d> points_m, const Box& shown_m) {
  return static_cast<std::size_t>(
      std::ranges::count_if(points_m, [&](const Eigen::Vector2d& point) { return !shown_m.contains(point); }));
}

double shorter_side_m(const Box& box) { return (box.high - box.low).minCoeff(); }

std::string counted(std::size_t count, const std::string& word) {
  return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

}  // namespace

Extent view_of(const MapPicture& picture) {
  const Extent trusted = trusted_extent(picture);
  const double size_m = trusted.empty ? 0.0 : trusted.size_m().maxCoeff();
  Extent others;
  for (const PathPiece& piece : picture.estimate)
    if (!piece.lost) others.include(piece.line);
  others.include(picture.odometry);
  others.include(picture.smoothed);
  Extent shown = trusted;
  const Extent landmarks = known_landmarks(picture, trusted);
  if (!landmarks.empty) shown.include(std::array{landmarks.low_m, landmarks.high_m});
  const Extent extent = shown.stretched(others, 0.15 * size_m);
  return extent.padded(std::max(0.5, 0.03 * extent.size_m().maxCoeff()));
}

bool is_well_known(const PlottedLandmark& landmark, double view_m) {
  return landmark.is_known && ellipse_ink(semi_major_m(landmark.point), view_m) > 0.0;
}

LeftOut left_out(const MapPicture& picture, const Box& shown_m) {
  LeftOut result;
  const double view_m = shorter_side_m(shown_m);
  for (const PathPiece& piece : picture.estimate) {
    result.estimates += outside(piece.line, shown_m);
    result.of_estimates += piece.line.size();
  }
  result.odometry = outside(picture.odometry, shown_m);
  result.of_odometry = picture.odometry.size();
  result.smoothed = outside(picture.smoothed, shown_m);
  result.of_smoothed = picture.smoothed.size();
  for (const PlottedLandmark& landmark : picture.landmarks)
    result.landmarks += !shown_m.contains(landmark.point.p_map_m);
  result.of_landmarks = picture.landmarks.size();
  result.true_landmarks = outside(picture.true_landmarks, shown_m);
  for (const UncertainPoint& pose : picture.poses)
    result.pose_ellipses += !(ellipse_ink(semi_major_m(pose), view_m) > 0.0);
  return result;
}

std::string words(const LeftOut& left_out, const std::string& landmark_word) {
  std::vector<std::string> parts;
  const auto share = [](std::size_t part, std::size_t all) {
    return fmt::format("{:.0f} %", std::max(1.0, 100.0 * static_cast<double>(part) / static_cast<double>(all)));
  };
  if (left_out.landmarks > 0)
    parts.push_back(fmt::format("{} of {} {}s", left_out.landmarks, left_out.of_landmarks, landmark_word));
  if (left_out.true_landmarks > 0) parts.push_back(counted(left_out.true_landmarks, "true landmark"));
  if (left_out.estimates > 0)
    parts.push_back(share(left_out.estimates, left_out.of_estimates) + " of the estimated path");
  if (left_out.odometry > 0) parts.push_back(share(left_out.odometry, left_out.of_odometry) + " of the odometry");
  if (left_out.smoothed > 0)
    parts.push_back(share(left_out.smoothed, left_out.of_smoothed) + " of the path in hindsight");
  std::string text = parts.empty() ? "" : fmt::format("Outside of the frame: {}.", fmt::join(parts, ", "));
  if (left_out.pose_ellipses > 0)
    text += fmt::format("{}Not drawn: {} of the position, larger than the view.", text.empty() ? "" : "  ",
                        counted(left_out.pose_ellipses, "ellipse"));
  return text;
}

}  // namespace azimuth
