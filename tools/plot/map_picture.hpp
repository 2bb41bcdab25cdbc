#pragma once
// The picture of a replay: true path, estimated path and map, with the covariance ellipses of poses and landmarks.

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "slam/geometry/pose2.hpp"
#include "tools/plot/canvas.hpp"
#include "tools/plot/clip.hpp"
#include "tools/plot/landmark_style.hpp"

namespace azimuth {

/// A piece of the estimated path.
struct PathPiece {
  PlotLine line;
  bool lost = false;  ///< the estimator was lost
};

/// A point with its covariance.
struct UncertainPoint {
  Eigen::Vector2d p_map_m = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();
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

/// Draws a picture of 1600 pixels width.
PlotCanvas drawn_map(const MapPicture& picture, PlotFormat format);

/// Writes drawn_map(). The file name extension determines the format: see plot_format(). Returns the
/// reason if it fails.
[[nodiscard]] std::optional<std::string> write_map_picture(const MapPicture& picture,
                                                           const std::filesystem::path& file);

inline constexpr double kDrawnSigmas = 2.0;

/// Semi-major axis of the ellipse of kDrawnSigmas [m]; infinite if the covariance is not finite.
double semi_major_m(const UncertainPoint& point);

/// Polygon approximation of the ellipse of kDrawnSigmas in the map frame.
std::vector<Eigen::Vector2d> ellipse_outline_m(const UncertainPoint& point);

/// Opacity factor of an ellipse in a view whose shorter side has length `view_m`. It is 1 up to a diameter of a tenth
/// of the view, decreases for larger ellipses so that all need about the same ink, and is 0 if the diameter exceeds the
/// view.
double ellipse_ink(double semi_major_m, double view_m);

}  // namespace azimuth
