#include "tools/export/kitti_export.hpp"

#include <array>
#include <cmath>

#include "drivers/wire/number_text.hpp"

namespace azimuth {
namespace {

/// A T A^-1, where A converts robot axes to camera axes: x_c = -y_r, y_c = -z_r, z_c = x_r.
std::array<double, 12> camera_pose(const Pose2& T) {
  const double c = std::cos(T.heading_rad), s = std::sin(T.heading_rad);
  return {c, 0.0, -s, 0.0 - T.y_m, 0.0, 1.0, 0.0, 0.0, s, 0.0, c, T.x_m};
}

}  // namespace

std::string kitti_text(const Estimated& estimated) {
  std::string text;
  for (const EstimatedPose& pose : estimated.poses) {
    char separator = '\0';
    for (const double value : camera_pose(pose.T_map_body)) {
      if (separator != '\0') text += separator;
      append_double(text, value + 0.0);  // turns -0 into 0
      separator = ' ';
    }
    text += '\n';
  }
  return text;
}

std::string kitti_times(const Estimated& estimated) {
  std::string text;
  for (const EstimatedPose& pose : estimated.poses) {
    append_seconds(text, Stamp{pose.stamp - estimated.poses.front().stamp});
    text += '\n';
  }
  return text;
}

}  // namespace azimuth
