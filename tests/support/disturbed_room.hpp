#pragma once
// A room in use: the light changes, one side is darker, people walk through it. The disturbance is painted into the
// images of a recorded drive at the true poses of the camera, and is the same in every repetition.

#include <vector>

#include "drivers/storage/run.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/geometry/pose2.hpp"
#include "tests/support/spoilt_perception.hpp"

namespace azimuth::test {

/// A person who walks back and forth between two places and rests at each for a while.
struct Walker {
  Eigen::Vector2d from_m, to_m;  ///< end points in the world
  double speed_m_per_s = 0.8;
  double rest_s = 6.0;
  double phase_s = 0.0;
  int red = 150, green = 30, blue = 35;  ///< colour of the jacket

  Eigen::Vector2d at(double t_s) const;
};

/// The disturbances of the room.
struct RoomTrouble {
  double dimmest = 1.0;           ///< lowest share of the light; the light falls to it and rises again, image by image
  double dimming_images = 150.0;  ///< period of the change of light, in images
  /// Share of the light at the end of the room in the direction `dark_towards_rad` (world).
  double darker_side = 1.0;
  double dark_towards_rad = 0.0;
  double room_m = 7.0;  ///< from the origin of the world to the dark end
  /// Height of the observed ceiling above the camera; 0: the camera sees objects a few metres away.
  double ceiling_m = 0.0;
  std::vector<Walker> people = {};

  bool is_none() const { return dimmest == 1.0 && darker_side == 1.0 && people.empty(); }
};

/// Paints the trouble as the camera of this run sees it. The rig and the truth of the run define the geometry.
Spoil spoil_of(const RoomTrouble& trouble, const Run& run, const CameraRig& rig);

/// The run with odometry that reports `factor` times the driven distance.
Run with_scaled_odometry(Run run, double factor);

/// The run with newly drawn odometry noise as specified by `rig`, and one reading at each true pose.
Run with_drawn_odometry(Run run, const OdometryRig& rig, unsigned seed);

}  // namespace azimuth::test
