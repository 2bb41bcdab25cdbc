#pragma once
// A simulated drive among named landmarks. The noise of motions and bearings equals the noise that they state.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/smoother/smoother.hpp"

namespace azimuth {

struct NamedDriveOptions {
  std::uint64_t seed = 1;
  int images = 60;
  int landmarks = 15;
  double step_m = 0.2;
  double radius_m = 3.0;  ///< of the circular path, whose centre is the middle of the room
  double room_m = 10.0;   ///< side of the room
  double range_m = 6.0;   ///< range of the camera
  double view_rad = 6.3;  ///< width of the field of view, centred ahead
  int most_bearings = 4;  ///< per image
  double sigma_rad = 0.02;
  double outliers = 0.0;    ///< share of bearings with a random direction
  double scale_turn = 1.0;  ///< factor on each turn that odometry reports
  double camera_yaw_rad = 0.0;
};

struct NamedDrive {
  struct Sighting {
    int landmark;
    double azimuth_rad;
  };
  struct Image {
    Pose2 T_first_body;  ///< true pose
    Motion motion;       ///< from the previous image, by odometry
    std::vector<Sighting> bearings;
  };
  NamedDriveOptions options;
  std::vector<Eigen::Vector2d> p_first_landmark;  ///< true positions
  std::vector<Image> images;
};
NamedDrive named_drive(const NamedDriveOptions& options);

/// Adds the images of a drive to a smoother one by one and assigns each bearing to its true landmark.
class DriveFeeder {
 public:
  explicit DriveFeeder(const NamedDrive& drive)
      : drive_(drive), landmark_of_(static_cast<std::size_t>(drive.options.landmarks), kOfNothing) {}

  bool done() const { return next_ == drive_.images.size(); }
  /// Adds the next image without solving.
  void feed(Smoother& smoother);
  /// Landmark id by number in the drive; kOfNothing: not seen yet.
  LandmarkId landmark(int number) const { return landmark_of_[static_cast<std::size_t>(number)]; }

 private:
  const NamedDrive& drive_;
  std::size_t next_ = 0;
  std::vector<LandmarkId> landmark_of_;
};

}  // namespace azimuth
