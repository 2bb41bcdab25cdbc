#pragma once
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "drivers/camera/frame.hpp"
#include "sim/renderer/cylinder_pass.hpp"
#include "sim/renderer/image_sensor.hpp"
#include "sim/renderer/ray_table.hpp"
#include "sim/renderer/render_scene.hpp"
#include "sim/renderer/room_pass.hpp"
#include "slam/camera/camera_model.hpp"
#include "slam/camera/image_mask.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// A camera on the robot, as far as its directions do not say.
struct RenderCamera {
  CameraModel model;
  int width_px = 1024;
  int height_px = 768;
  MaskShape mask;         ///< the ring shows the world; robot and mounting are black inside it
  double height_m = 1.0;  ///< of the viewpoint above the floor
  Pose2 T_body_camera;    ///< where the viewpoint is on the robot, and its zero azimuth
  ImageSensorSettings sensor;
};

/// Where a frame is to be written.
struct FrameView {
  FrameFormat format;
  std::span<std::byte> bytes;
};

/// Renders what a robot's omnidirectional camera sees, fast enough for a live camera on part of one core.
///
/// Rays are taken from the camera's model pixel by pixel, so a frame agrees with the model exactly. Same scene, camera
/// and sequence of poses: same bytes.
///
/// A frame can be made at once or, by a process that has other things to do meanwhile, step by step.
///
/// Thread contract: thread-bound; nothing allocates after construction.
class Renderer {
 public:
  /// Why a camera cannot be rendered in this scene; nothing: it can.
  static std::optional<std::string_view> problem(const RenderScene& scene, const RenderCamera& camera);

  /// Only what has no problem.
  Renderer(const RenderScene& scene, const RenderCamera& camera);

  /// Whether render() can write frames like this.
  bool can_write(const FrameFormat& format) const;

  /// The frame seen from `T_world_body`; a camera that is beyond a wall sees what it would just inside. `out` must be
  /// writable as can_write() and large enough.
  void render(const Pose2& T_world_body, const FrameView& out);

  /// The same in steps of about a millisecond: after begin(), until step() says that the frame is whole. `out` must be
  /// the same for all steps of a frame.
  void begin(const Pose2& T_world_body);
  bool step(const FrameView& out);

 private:
  Renderer(const RenderScene& scene, const RenderCamera& camera, const CameraSpace& space);
  bool paint_room();
  bool paint_cylinders();
  bool read_sensor(const FrameView& out);

  enum class Stage { room, cylinders, sensor, whole };

  int width_px_, height_px_;
  Pose2 T_body_camera_;
  RayTable rays_;
  RoomPass room_;
  CylinderPass cylinders_;
  ImageSensor sensor_;
  std::vector<PackedColour> image_;  // black where no ray comes from, once and for all
  Pose2 T_world_camera_;
  Stage stage_ = Stage::whole;
  std::size_t rays_painted_ = 0;
  int rows_read_ = 0;
};

}  // namespace azimuth
