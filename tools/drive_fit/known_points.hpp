#pragma once
// Compares a fitted drive with independent measurements: a true path or surveyed landmarks. They determine the scale of
// path and map, and whether both are mirrored. Bearings and odometry determine neither.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "drivers/storage/run.hpp"
#include "tools/drive_fit/drive_graph.hpp"

namespace azimuth {

struct KnownPoint {
  Eigen::Vector2d found = Eigen::Vector2d::Zero();  ///< position in the solution's frame
  Eigen::Vector2d p_world = Eigen::Vector2d::Zero();
};

/// Points of the fitted path, paired with the run's true path.
std::vector<KnownPoint> points_on_path(const DriveSolution& solution, std::span<const TruthPose> truth);
/// Landmarks of the map, paired with surveyed landmarks of the same identity.
std::vector<KnownPoint> points_of_map(const DriveSolution& solution, std::span<const TrueLandmark> landmarks);

/// Ratio of true lengths to fitted lengths.
struct LengthScale {
  double scale = 1.0, sigma = 0.0;
};

struct Likeness {
  LengthScale lengths;
  bool mirrored = false;   ///< the points only match after mirroring
  bool hand_told = false;  ///< false if the points are too collinear to decide `mirrored`
};
/// Fits the least-squares similarity between the points. sigma results from a jackknife over ten parts. Nothing if
/// there are too few points or all coincide.
std::optional<Likeness> likeness(std::span<const KnownPoint> points);

/// Scale from the measured distance between two landmarks. Nothing if one of them has no position in the map.
std::optional<LengthScale> scale_between(const Drive& drive, const DriveSolution& solution,
                                         const HindsightSettings& settings, Identity from, Identity to,
                                         double distance_m);

}  // namespace azimuth
