#pragma once
// What was measured otherwise beside a drive: it tells the size of path and map, and which hand they have. Bearings and
// odometry tell neither.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "drivers/storage/run.hpp"
#include "tools/drive_fit/drive_graph.hpp"

namespace azimuth {

struct KnownPoint {
  Eigen::Vector2d found = Eigen::Vector2d::Zero();  ///< in the solution's frame
  Eigen::Vector2d p_world = Eigen::Vector2d::Zero();
};

/// Path beside the run's truth.
std::vector<KnownPoint> points_on_path(const DriveSolution& solution, std::span<const TruthPose> truth);
/// Landmarks beside those of the same name that were surveyed.
std::vector<KnownPoint> points_of_map(const DriveSolution& solution, std::span<const TrueLandmark> landmarks);

/// True lengths over found ones.
struct LengthScale {
  double scale = 1.0, sigma = 0.0;
};

struct Likeness {
  LengthScale lengths;
  bool mirrored = false;   ///< only a mirror brings one onto the other
  bool hand_told = false;  ///< else points lie too much in a line to tell
};
/// By the similarity that brings the points closest; sigma by leaving out a tenth of them at a time. Nothing where they
/// are too few, or one place.
std::optional<Likeness> likeness(std::span<const KnownPoint> points);

/// By the distance of two landmarks that was measured. Nothing: one of them has no place in the map.
std::optional<LengthScale> scale_between(const Drive& drive, const DriveSolution& solution,
                                         const HindsightSettings& settings, Identity from, Identity to,
                                         double distance_m);

}  // namespace azimuth
