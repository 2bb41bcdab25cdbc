#pragma once
// A simulated drive among landmarks that are told apart: motions and bearings with the noise that they say they have.

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
  double radius_m = 3.0;  ///< of the circle that is driven, about the middle of the room
  double room_m = 10.0;   ///< its side
  double range_m = 6.0;   ///< seen up to
  double view_rad = 6.3;  ///< width, about straight on
  int most_bearings = 4;  ///< of an image
  double sigma_rad = 0.02;
  double outliers = 0.0;    ///< share of bearings that point anywhere
  double scale_turn = 1.0;  ///< odometry says this times the turn
  double camera_yaw_rad = 0.0;
};

struct NamedDrive {
  struct Sighting {
    int landmark;
    double azimuth_rad;
  };
  struct Image {
    Pose2 T_first_body;  ///< true
    Motion motion;       ///< from the image before, by odometry
    std::vector<Sighting> bearings;
  };
  NamedDriveOptions options;
  std::vector<Eigen::Vector2d> p_first_landmark;  ///< true
  std::vector<Image> images;
};
NamedDrive named_drive(const NamedDriveOptions& options);

/// Puts the images of a drive into a smoother one by one, each bearing to its landmark.
class DriveFeeder {
 public:
  explicit DriveFeeder(const NamedDrive& drive)
      : drive_(drive), landmark_of_(static_cast<std::size_t>(drive.options.landmarks), kOfNothing) {}

  bool done() const { return next_ == drive_.images.size(); }
  /// Adds the next image; nothing is solved.
  void feed(Smoother& smoother);
  /// By number in the drive; kOfNothing: not seen yet.
  LandmarkId landmark(int number) const { return landmark_of_[static_cast<std::size_t>(number)]; }

 private:
  const NamedDrive& drive_;
  std::size_t next_ = 0;
  std::vector<LandmarkId> landmark_of_;
};

}  // namespace azimuth
