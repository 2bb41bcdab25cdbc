#pragma once
// Drives under a ceiling of lamps that all look alike, with the truth that recordings of a camera lack: which lamp each
// sighting is of.

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

inline constexpr double kMapped_m = 1.5;  ///< an estimate farther than this maps none of the lamps

/// Image by image.
struct LampRun {
  static constexpr int kClutter = -1;

  Rig rig;
  std::vector<Motion> motions;  ///< before each image
  std::vector<BearingSet> sets;
  std::vector<std::vector<int>> lamp_of;  ///< of each sighting
  std::vector<Pose2> truth;
  std::vector<Eigen::Vector3d> lamps;
};

/// The camera of the second paper's hall: a fisheye 1.8 m above the floor that sees to 70 degrees from the zenith.
Rig lamp_rig();

/// 2.2 rounds of an ellipse in a hall with 16 lamps at 6.5 m, 320 images, odometry noise as the rig says. Lamps are
/// missed with the rig's probability, and clutter is seen now and then. Each lamp is mounted up to `off_m` off its
/// place in a regular grid, along each axis; where that is 0 the hall looks the same turned by half a turn.
LampRun simulated_hall(std::uint64_t seed, double off_m = 0.0);

/// Any path below any lamps, an image at each pose; camera, odometry and what is missed as in simulated_hall().
LampRun driven_hall(std::vector<Eigen::Vector3d> lamps, std::span<const Pose2> path, std::uint64_t seed);

/// What came of a run.
struct LampOutcome {
  double position_mean_m = 0.0, position_max_m = 0.0;  ///< after the best rigid motion
  double anees = 0.0;                                  ///< of the pose, 3 degrees of freedom, from the first pose on
  std::vector<double> lamp_errors_m;                   ///< in space, of the true lamps that are mapped
  std::size_t landmarks = 0;
  std::size_t right = 0, wrong = 0;  ///< recognitions in the last images, by what the map held half a run before
  bool closed() const { return right > 4 * wrong && right > 0; }
  double lamp_mean_m() const;
};
LampOutcome drive(const LampRun& run, const FastSlamSettings& settings);
LampOutcome drive(const LampRun& run, const LampEkfSettings& settings);

/// Of the pose by its own covariance, in the frame of the first pose, in which the map begins.
double squared_error(const Estimate& estimate, const Pose2& T_first_body);

/// A folder of hall-runs, with the lamps seen found out from the truth.
LampRun recorded_hall(const std::filesystem::path& folder);

}  // namespace azimuth
