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

/// The facts by which the health of an estimate is judged.
struct Evidence {
  Eigen::Matrix3d pose_covariance = Eigen::Matrix3d::Zero();  ///< (x [m], y [m], heading [rad])
  std::size_t landmarks = 0;
  std::size_t max_landmarks = std::numeric_limits<std::size_t>::max();  ///< Limit of the map's size
  double map_reach_m = 0.0;                   ///< Distance from the map's origin to its farthest landmark; 0: unknown
  double unrecognised_m = 0.0;                ///< Distance driven since a mapped landmark was recognised
  int contradictions = 0;                     ///< Bearings rejected since one was accepted
  int inflations = 0;                         ///< Inflations of the pose covariance by these contradictions
  int troubled_images = 0;                    ///< Consecutive useless images
  ImageTrouble trouble = ImageTrouble::none;  ///< Trouble of the last image
  std::optional<CameraErrors> camera;
  std::optional<LagFound> lag;
  bool rig_contradicted = false;  ///< The bearings contradict the rig, and the estimates made so far relied on the rig
};

struct Judgement {
  Health health = Health::tracking;
  std::string_view reason;  ///< Static text; empty when tracking
};

/// Whether a pose with this covariance counts as lost in a map of this reach, whatever else is known.
bool is_too_uncertain(const Eigen::Matrix3d& pose_covariance, const HealthSettings& settings, double map_reach_m = 0.0);

/// Whether the camera's tilt certainly differs from its rig's.
bool is_tilted(const std::optional<CameraErrors>& camera, const HealthSettings& settings);

/// The worst verdict that the evidence supports. Thread contract: reentrant.
Judgement judge(const Evidence& evidence, const HealthSettings& settings);

}  // namespace azimuth
