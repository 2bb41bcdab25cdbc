#pragma once
// Cameras, scenes and frames for tests of the renderer.

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "sim/renderer/renderer.hpp"

namespace azimuth::test {

inline const ImageAxes kAxes{{512.0, 384.0}, 1.0, -1, -kPi / 2};

inline RenderCamera camera_of(const RadialProfile& profile, double inner_px, double outer_px) {
  return {.model = CameraModel(kAxes, profile),
          .mask = {inner_px, outer_px, {}},
          .height_m = 1.0,
          .T_body_camera = {},
          .sensor = {}};
}
inline RenderCamera mirror_camera() { return camera_of(HyperbolicMirror{28.095, 23.4125, 1035.376}, 60.0, 376.0); }
inline RenderCamera parabolic_camera() { return camera_of(ParabolicMirror{285.403}, 60.0, 376.0); }
/// The view extends from the zenith to 20 degrees below the horizon.
inline RenderCamera fisheye_camera() { return camera_of(EquidistantFisheye{200.0, 1.92}, 0.0, 384.0); }

struct NamedRenderCamera {
  std::string name;
  RenderCamera camera;
};
inline std::ostream& operator<<(std::ostream& out, const NamedRenderCamera& each) { return out << each.name; }
inline std::vector<NamedRenderCamera> render_cameras() {
  return {{"mirror", mirror_camera()}, {"parabolic", parabolic_camera()}, {"fisheye", fisheye_camera()}};
}

inline RenderScene empty_room() {
  RenderScene scene;
  scene.room = {{-6.0, -5.0}, {7.0, 5.0}};
  scene.seed = 3;
  return scene;
}

/// Renders one frame in a packed format.
inline std::vector<std::byte> frame_of(Renderer& renderer, const RenderCamera& camera, const Pose2& T_world_body,
                                       PixelFormat pixels = PixelFormat::gray8) {
  const FrameFormat format = packed_format(pixels, camera.width_px, camera.height_px);
  std::vector<std::byte> bytes(format.bytes());
  renderer.render(T_world_body, {format, bytes});
  return bytes;
}
inline std::vector<std::byte> frame_of(const RenderScene& scene, const RenderCamera& camera, const Pose2& T_world_body,
                                       PixelFormat pixels = PixelFormat::gray8) {
  Renderer renderer(scene, camera);
  return frame_of(renderer, camera, T_world_body, pixels);
}

/// The direction from the camera to a point, computed from geometry only.
inline Direction predicted(const RenderCamera& camera, const Pose2& T_world_body, const Eigen::Vector3d& p_world) {
  const Pose2 T_camera_world = inverse(T_world_body * camera.T_body_camera);
  const Eigen::Vector2d flat = T_camera_world * Eigen::Vector2d(p_world.head<2>());
  return direction(Eigen::Vector3d(flat.x(), flat.y(), p_world.z() - camera.height_m));
}

/// The difference between two frames, as a weighted set of pixels.
struct Change {
  double weight = 0.0;
  Pixel centroid = Pixel::Zero();
  double azimuth_error_px = 0.0;  ///< mean distance across the predicted line of sight, counter-clockwise positive
};
inline Change change_between(const std::vector<std::byte>& before, const std::vector<std::byte>& after,
                             const RenderCamera& camera, double azimuth_rad) {
  Change change;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double weight = std::abs(std::to_integer<int>(after[i]) - std::to_integer<int>(before[i]));
    if (weight == 0.0) continue;
    const auto width = static_cast<std::size_t>(camera.width_px);
    const std::size_t row = i / width;
    const Pixel pixel{static_cast<double>(i % width), static_cast<double>(row)};
    const PolarPixel polar = camera.model.axes().polar(pixel);
    change.weight += weight;
    change.centroid += weight * pixel;
    change.azimuth_error_px += weight * polar.radius_px * std::sin(polar.azimuth_rad - azimuth_rad);
  }
  change.centroid /= change.weight;
  change.azimuth_error_px /= change.weight;
  return change;
}

}  // namespace azimuth::test
