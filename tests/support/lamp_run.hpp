#pragma once
// Drives under a ceiling of identical lamps, with the true lamp of each sighting, which camera recordings lack.

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "slam/ceiling/lamp_ekf_settings.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/fastslam/fastslam_settings.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

inline constexpr double kMapped_m = 1.5;  ///< largest distance between a lamp and its mapped estimate

/// A drive, image by image.
struct LampRun {
  static constexpr int kClutter = -1;

  Rig rig;
  std::vector<Motion> motions;  ///< odometry before each image
  std::vector<BearingSet> sets;
  std::vector<std::vector<int>> lamp_of;  ///< true lamp of each sighting, or kClutter
  std::vector<Pose2> truth;
  std::vector<Eigen::Vector3d> lamps;
};

/// Camera of the hall: a fisheye lens 1.8 m above the floor with a view up to 70 degrees from the zenith.
Rig lamp_rig();

/// 2.2 rounds of an ellipse in a hall with 16 lamps at a height of 6.5 m: 320 images, with the rig's odometry noise.
/// The images miss lamps with the rig's probability and contain some clutter. Each lamp is mounted up to `off_m` off
/// its place in a regular grid, along each axis. If `off_m` is 0, the hall looks the same after half a turn.
LampRun simulated_hall(std::uint64_t seed, double off_m = 0.0);

/// Any path under any lamps, with an image at each pose. Camera, odometry and missed detections are as in
/// simulated_hall().
LampRun driven_hall(std::vector<Eigen::Vector3d> lamps, std::span<const Pose2> path, std::uint64_t seed);

/// Result of a run.
struct LampOutcome {
  double position_mean_m = 0.0, position_max_m = 0.0;  ///< after the best rigid alignment
  double anees = 0.0;                                  ///< of the pose relative to the first pose, 3 degrees of freedom
  std::vector<double> lamp_errors_m;                   ///< 3-D errors of the true lamps that are mapped
  std::size_t landmarks = 0;
  std::size_t right = 0, wrong = 0;  ///< associations in the last images, judged by the map at half of the run
  bool closed() const { return right > 4 * wrong && right > 0; }
  double lamp_mean_m() const;
};
LampOutcome drive(const LampRun& run, const FastSlamSettings& settings);
LampOutcome drive(const LampRun& run, const LampEkfSettings& settings);

/// Squared error of the pose, normalised by its covariance. The pose is expressed in the frame of the first pose, where
/// the map starts.
double squared_error(const Estimate& estimate, const Pose2& T_first_body);

/// Reads a folder of hall-runs. The true poses determine the lamp of each bearing.
LampRun recorded_hall(const std::filesystem::path& folder);

}  // namespace azimuth
