#pragma once
// The picture of a replay: where the robot was, where it thought it was, and the map it made.

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
  bool lost = false;  ///< the estimator said that it did not know where the robot was
};

struct PlottedLandmark {
  UncertainPoint point;
  std::string name;                     ///< written beside it where there is room
  int kind = -1;                        ///< index into MapPicture::kinds; -1: of none
  bool is_known = true;                 ///< false: seen from too few places to be relied on
  std::optional<std::int64_t> id = {};  ///< in the map; nothing where the sensor has a name for it
};

/// Everything in the map frame, metres. Whatever is empty is left out, also of the legend.
struct MapPicture {
  std::string title;
  std::string subtitle;
  std::vector<PathPiece> estimate;
  std::vector<PlotLine> truth;  ///< in pieces where truth has holes
  PlotLine odometry;
  PlotLine calibrated;                ///< odometry with the errors taken out that were found
  PlotLine smoothed;                  ///< where the robot was, as it is known at the end
  std::vector<UncertainPoint> poses;  ///< some instants, for their ellipses
  std::vector<PlottedKind> kinds;
  std::vector<PlottedLandmark> landmarks;
  std::string landmark_word = "landmark";
  std::vector<Eigen::Vector2d> true_landmarks;
  std::string true_landmark_words = "true landmark";
  std::optional<Pose2> T_map_body;  ///< of the robot at the end
};

/// Writes a picture 1600 pixels wide, as the ending of the file's name says: see plot_format(). The reason when it
/// fails.
[[nodiscard]] std::optional<std::string> write_map_picture(const MapPicture& picture,
                                                           const std::filesystem::path& file);

}  // namespace azimuth
