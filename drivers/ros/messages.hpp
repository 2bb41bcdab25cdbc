#pragma once
// The ROS messages for estimates, as plain values. Names and units are those of ROS's own definitions: metres, radians,
// seconds. Fields with the same value in all messages of a type (no mesh, no texture) are left out; serialize.hpp and
// the bridge to ROS 2 add them.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "slam/sample/stamp.hpp"

namespace azimuth::ros {

struct Header {
  Stamp stamp{};
  std::string frame_id;
};

struct Vector3 {
  double x = 0.0, y = 0.0, z = 0.0;
};

struct Quaternion {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
};

/// The pose of a body in a frame, or of a child frame in its parent.
struct Pose {
  Vector3 position;
  Quaternion orientation;
};

/// Covariance of x, y, z and the rotations about these axes, row by row.
using Covariance = std::array<double, 36>;

struct PoseStamped {
  Header header;
  Pose pose;
};

struct PoseWithCovarianceStamped {
  Header header;
  Pose pose;
  Covariance covariance{};
};

struct Twist {
  Vector3 linear, angular;
};

struct Odometry {
  Header header;
  std::string child_frame_id;
  Pose pose;
  Covariance pose_covariance{};
  Twist twist;  ///< in the child frame
  Covariance twist_covariance{};
};

struct TransformStamped {
  Header header;
  std::string child_frame_id;
  Pose transform;
};

struct TransformMessage {
  std::vector<TransformStamped> transforms;
};

struct Path {
  Header header;
  std::vector<PoseStamped> poses;
};

struct Colour {
  float r = 0.0F, g = 0.0F, b = 0.0F, a = 1.0F;
};

struct Marker {
  // The types and actions that are used here.
  static constexpr std::int32_t kSphere = 2, kCylinder = 3, kText = 9;
  static constexpr std::int32_t kAdd = 0, kDeleteAll = 3;

  Header header;
  std::string ns;
  std::int32_t id = 0;
  std::int32_t type = kSphere;
  std::int32_t action = kAdd;
  Pose pose;
  Vector3 scale;
  Colour color;
  std::string text;
};

struct MarkerArray {
  std::vector<Marker> markers;
};

struct KeyValue {
  std::string key, value;
};

struct DiagnosticStatus {
  static constexpr std::uint8_t kOk = 0, kWarn = 1, kError = 2, kStale = 3;

  std::uint8_t level = kOk;
  std::string name, message, hardware_id;
  std::vector<KeyValue> values;
};

struct DiagnosticArray {
  Header header;
  std::vector<DiagnosticStatus> status;
};

}  // namespace azimuth::ros
