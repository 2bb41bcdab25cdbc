#pragma once
// Detects odometry that reports motion while the robot stands.

#include "tools/drive_fit/drive_graph.hpp"

namespace azimuth {

/// Compares odometry with bearings in stretches in which odometry moves slowly. Constant bearings mean that the robot
/// stands.
struct Creep {
  double slow_s = 0.0;      ///< total duration of slow stretches with landmarks in view
  double standing_s = 0.0;  ///< part of slow_s in which the bearings are constant but odometry reports motion
  double turned_rad = 0.0;  ///< sum of the turns that odometry reports during standing_s
  double driven_m = 0.0;    ///< sum of the distances that odometry reports during standing_s
  int stretches = 0;        ///< number of stretches in standing_s
  double evidence = 0.0;    ///< ln of the likelihood ratio of the bearings, standing over moving

  double rad_per_s() const { return standing_s > 0.0 ? turned_rad / standing_s : 0.0; }
  double m_per_s() const { return standing_s > 0.0 ? driven_m / standing_s : 0.0; }
  /// True if the creep is certain and large enough to matter within a minute.
  bool is_told() const;
};

/// The rig with noise floors that cover the creep. The floors apply to each second, or each step, in which odometry
/// reports motion.
OdometryRig with_floors_of(const OdometryRig& rig, const Creep& creep);

/// Measures the creep with the landmarks and the odometry rig of `solution`.
Creep creep_of(const Drive& drive, const DriveSolution& solution);

}  // namespace azimuth
