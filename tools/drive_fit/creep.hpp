#pragma once
// An odometer that goes on while the robot stands.

#include "tools/drive_fit/drive_graph.hpp"

namespace azimuth {

/// What odometry and bearings say of stretches in which odometry hardly moves. Bearings that stay where they are mean
/// that the robot stands.
struct Creep {
  double slow_s = 0.0;      ///< of such stretches, in sight of landmarks
  double standing_s = 0.0;  ///< of these: bearings say that the robot stands, and odometry that it does not
  double turned_rad = 0.0;  ///< in those, the sum of magnitudes
  double driven_m = 0.0;
  int stretches = 0;
  double evidence = 0.0;  ///< ln of how many times likelier bearings are from where the robot stands

  double rad_per_s() const { return standing_s > 0.0 ? turned_rad / standing_s : 0.0; }
  double m_per_s() const { return standing_s > 0.0 ? driven_m / standing_s : 0.0; }
  /// For sure, and so much that a minute of it matters.
  bool is_told() const;
};

/// With floors that cover it: they count for each second, or each step, in which the odometer says that it moves.
OdometryRig with_floors_of(const OdometryRig& rig, const Creep& creep);

/// Landmarks are where `solution` has them, and odometry is that of its rig.
Creep creep_of(const Drive& drive, const DriveSolution& solution);

}  // namespace azimuth
