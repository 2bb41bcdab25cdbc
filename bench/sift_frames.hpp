#pragma once
// Frames with known poses, and what a detector finds again in them.

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
  CameraRig rig;  ///< with a model that knows elevations
  std::vector<PosedFrame> frames;
};

/// The first frames of office-a where the environment variable AZIMUTH_DATA leads to it, else of a rendered lab; about
/// 0.2 m from each to the next.
const PosedDrive& bench_drive();

/// Features of one frame.
struct SeenRays {
  std::vector<Descriptor> looks;
  std::vector<Eigen::Vector3d> rays;  ///< in the robot's frame, of length 1
};

struct Repeated {
  double share = 0.0;        ///< of features matched in a later frame, and consistent with both poses
  double wrong_share = 0.0;  ///< of matches: not consistent
  double features = 0.0;     ///< an image
};

/// Matches each frame's features with those `later` frames on, by the ratio of nearest to second nearest descriptor.
/// A match is consistent when, given both true poses, some point from 0.3 to 30 m away is seen along both rays to
/// within a degree. A wrong match passes by chance in about one of thirty cases.
Repeated find_again(const PosedDrive& drive, const std::vector<SeenRays>& seen, std::size_t later, double ratio);

}  // namespace azimuth
