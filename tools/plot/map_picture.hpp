#pragma once
// The picture of a replay: where the robot was, where it thought it was, and the map it made.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// A point with the covariance whose 2-sigma ellipse is drawn round it.
struct UncertainPoint {
  Eigen::Vector2d p_map_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();
};

using PlotLine = std::vector<Eigen::Vector2d>;

/// Everything in the map frame, metres. Whatever is empty is left out, also of the legend.
struct MapPicture {
  std::string title;
  std::string subtitle;
  PlotLine estimate;
  std::vector<PlotLine> truth;  ///< in pieces where truth has holes
  PlotLine odometry;
  std::vector<UncertainPoint> poses;  ///< some instants, for their ellipses
  std::vector<UncertainPoint> landmarks;
  std::vector<Eigen::Vector2d> true_landmarks;
  std::optional<Pose2> T_map_body;  ///< of the robot at the end
};

/// Writes a PNG 1600 pixels wide. The reason when it fails.
[[nodiscard]] std::optional<std::string> write_png(const MapPicture& picture, const std::string& file);

}  // namespace azimuth
