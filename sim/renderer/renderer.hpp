#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/camera/frame.hpp"
#include "sim/renderer/image_sensor.hpp"
#include "sim/renderer/passes.hpp"
#include "sim/renderer/ray_table.hpp"
#include "sim/renderer/render_scene.hpp"
#include "slam/camera/camera_model.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/camera/image_mask.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// A camera on the robot: its model and the properties that the model does not contain.
struct RenderCamera {
  CameraModel model;
  int width_px = 1024;
  int height_px = 768;
  MaskShape mask;         ///< The ring shows the world; robot and mounting are black inside it
  double height_m = 1.0;  ///< Height of the viewpoint above the floor
  Pose2 T_body_camera;    ///< Viewpoint on the robot, and the camera's zero azimuth
  ImageSensorSettings sensor;
};

/// The destination of a frame.
struct FrameView {
  FrameFormat format;
  std::span<std::byte> bytes;
};

/// Renders the images of a robot's omnidirectional camera, at the rate of a live camera on a part of one core.
///
/// Each pixel's ray comes from the camera model, so a frame agrees with the model exactly. The same scene, camera and
/// sequence of poses give the same bytes.
///
/// A frame can be rendered at once or in steps.
///
/// Thread contract: thread-bound; nothing allocates after construction.
class Renderer {
 public:
  /// The reason why the camera cannot be rendered in this scene; nullopt if it can.
  static std::optional<std::string_view> problem(const RenderScene& scene, const RenderCamera& camera);

  /// problem() must return nullopt for these arguments.
  Renderer(const RenderScene& scene, const RenderCamera& camera);

  /// Whether render() can write frames of this format.
  bool can_write(const FrameFormat& format) const;

  /// Renders the frame seen from `T_world_body`. A camera beyond a wall sees what it would see just inside. `out` must
  /// pass can_write() and be large enough.
  void render(const Pose2& T_world_body, const FrameView& out);

  /// Renders a frame in steps of about a millisecond: call begin(), then step() until it returns true, which means that
  /// the frame is complete. `out` must be the same in all steps of a frame.
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
  std::vector<PackedColour> image_;  // Pixels without a ray stay black
  Pose2 T_world_camera_;
  Stage stage_ = Stage::whole;
  std::size_t rays_painted_ = 0;
  int rows_read_ = 0;
};

/// The camera that rig.toml describes: model, mask, height and yaw. Returns nullopt, and the reason in `problem`, if
/// the rig describes no image camera or its parameters are not valid.
std::optional<RenderCamera> render_camera_of(const CameraRig& rig, std::string& problem);

}  // namespace azimuth
