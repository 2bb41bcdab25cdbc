#pragma once
#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string_view>

#include "slam/ekf/camera_errors.hpp"
#include "slam/ekf/rig_told.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// What the health of an estimate is judged by.
struct Evidence {
  Eigen::Matrix3d pose_covariance = Eigen::Matrix3d::Zero();  ///< (x [m], y [m], heading [rad])
  std::size_t landmarks = 0;
  std::size_t max_landmarks = std::numeric_limits<std::size_t>::max();  ///< the map grows no further
  double map_reach_m = 0.0;                   ///< from where it began to its farthest landmark; 0: nobody knows
  double unrecognised_m = 0.0;                ///< driven since a mapped landmark was recognised
  int deaf_sightings = 0;                     ///< bearings rejected since one was accepted
  int deaf_streaks = 0;                       ///< times the pose was made vaguer because of that, since then
  int troubled_images = 0;                    ///< in a row that were of no use
  ImageTrouble trouble = ImageTrouble::none;  ///< of the last image
  std::optional<CameraErrors> camera;
  std::optional<LagFound> lag;
  bool rig_contradicted = false;  ///< by what has been seen, and what was made of that went by the rig
};

struct Judgement {
  Health health = Health::tracking;
  std::string_view reason;  ///< static text; empty when tracking
};

/// A pose of this covariance is lost, whatever else is known: in a map of that reach.
bool is_too_uncertain(const Eigen::Matrix3d& pose_covariance, const HealthSettings& settings, double map_reach_m = 0.0);

/// The camera surely leans otherwise than its rig says.
bool is_tilted(const std::optional<CameraErrors>& camera, const HealthSettings& settings);

/// The worst that the evidence says. Thread contract: reentrant.
Judgement judge(const Evidence& evidence, const HealthSettings& settings);

}  // namespace azimuth
