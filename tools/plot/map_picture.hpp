#pragma once
// The picture of a replay: true path, estimated path and map.

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "slam/geometry/pose2.hpp"
#include "tools/plot/clip.hpp"
#include "tools/plot/ellipse.hpp"
#include "tools/plot/landmark_style.hpp"

namespace azimuth {

/// A piece of the estimated path.
struct PathPiece {
  PlotLine line;
  bool lost = false;  ///< the estimator was lost
};

struct PlottedLandmark {
  UncertainPoint point;
  std::string name;                     ///< written beside the landmark if there is space
  int kind = -1;                        ///< index into MapPicture::kinds; -1: no kind
  bool is_known = true;                 ///< false if the landmark was seen from too few places to be reliable
  std::optional<std::int64_t> id = {};  ///< id in the map; nothing if the sensor gives an identity
};

/// All coordinates are in the map frame, in metres. Empty members are omitted from the picture and the legend.
struct MapPicture {
  std::string title;
  std::string subtitle;
  std::vector<PathPiece> estimate;
  std::vector<PlotLine> truth;  ///< split into pieces at gaps in the truth
  PlotLine odometry;
  PlotLine calibrated;                ///< dead reckoning with calibrated odometry
  PlotLine smoothed;                  ///< smoothed path as known at the end
  std::vector<UncertainPoint> poses;  ///< selected poses whose ellipses are drawn
  std::vector<PlottedKind> kinds;
  std::vector<PlottedLandmark> landmarks;
  std::string landmark_word = "landmark";
  std::vector<Eigen::Vector2d> true_landmarks;
  std::string true_landmark_words = "true landmark";
  std::optional<Pose2> T_map_body;  ///< final pose of the robot
};

/// Writes a picture of 1600 pixels width. The file name extension determines the format: see plot_format(). Returns the
/// reason if it fails.
[[nodiscard]] std::optional<std::string> write_map_picture(const MapPicture& picture,
                                                           const std::filesystem::path& file);

}  // namespace azimuth
