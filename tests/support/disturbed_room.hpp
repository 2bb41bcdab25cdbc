#pragma once
// A room as it is when others use it: lights that change, a side that is darker, people. Painted into the images of a
// recorded drive, where the truth says the camera was; the same images every time.

#include <vector>

#include "drivers/storage/run.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/geometry/pose2.hpp"
#include "tests/support/spoilt_perception.hpp"

namespace azimuth::test {

/// Somebody who walks there and back between two places, and stands at each for a while.
struct Walker {
  Eigen::Vector2d from_m, to_m;  ///< world
  double speed_m_per_s = 0.8;
  double rest_s = 6.0;
  double phase_s = 0.0;
  int red = 150, green = 30, blue = 35;  ///< of the jacket

  Eigen::Vector2d at(double t_s) const;
};

/// What is wrong with the room.
struct RoomTrouble {
  double dimmest = 1.0;           ///< the light goes down to this share and up again, image by image
  double dimming_images = 150.0;  ///< from bright to bright
  double darker_side = 1.0;       ///< light at the end of the room in the direction `dark_towards_rad`, in the world
  double dark_towards_rad = 0.0;
  double room_m = 7.0;  ///< from the middle of the world to that end
  /// Height of what is looked at above the camera, where it is a ceiling; 0: things that stand a few metres away.
  double ceiling_m = 0.0;
  std::vector<Walker> people = {};

  bool is_none() const { return dimmest == 1.0 && darker_side == 1.0 && people.empty(); }
};

/// The trouble as the camera of this run sees it: its rig and its truth say what is where.
Spoil spoil_of(const RoomTrouble& trouble, const Run& run, const CameraRig& rig);

/// The run with an odometer that counts `factor` times the distance driven.
Run with_scaled_odometry(Run run, double factor);

/// The run with an odometer whose noise is drawn anew, as much as the rig says, with a reading at each true pose.
Run with_drawn_odometry(Run run, const OdometryRig& rig, unsigned seed);

}  // namespace azimuth::test
