#pragma once
// Frames with known poses, and the repeatability of features in them.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "slam/camera/camera_rig.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

struct PosedFrame {
  Pose2 T_world_body;
  FrameFormat format;  ///< grey
  std::vector<std::byte> bytes;
  ImageView view() const { return {format, bytes}; }
};

struct PosedDrive {
  std::string name;
  CameraRig rig;  ///< includes a camera model with elevations
  std::vector<PosedFrame> frames;
};

/// The first frames of office-a if it is in the folder AZIMUTH_DATA, else frames of a rendered lab; about 0.2 m apart.
const PosedDrive& bench_drive();

/// Features of one frame.
struct SeenRays {
  std::vector<Descriptor> looks;
  std::vector<Eigen::Vector3d> rays;  ///< unit vectors in the robot's frame
};

struct Repeated {
  double share = 0.0;        ///< share of the features whose match in the later frame is consistent with both poses
  double wrong_share = 0.0;  ///< share of the matches that are inconsistent
  double features = 0.0;     ///< per image
};

/// Matches the features of each frame with those `later` frames on, by the ratio of the distances to the nearest and
/// second nearest descriptor. A match is consistent if, with both true poses, some point 0.3 to 30 m away lies on both
/// rays within one degree. About one in thirty wrong matches is consistent by chance.
Repeated find_again(const PosedDrive& drive, const std::vector<SeenRays>& seen, std::size_t later, double ratio);

}  // namespace azimuth
