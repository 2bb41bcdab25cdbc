#include "sim/renderer/renderer.hpp"

#include <algorithm>
#include <cassert>

#include "slam/camera/make_camera.hpp"

namespace azimuth {
namespace {

constexpr PackedColour kNothing = colour(6, 6, 6);  // Robot, mounting and the area beyond the mirror's rim

// Each step takes about a millisecond.
constexpr std::size_t kRaysPerStep = 20'000, kCylindersPerStep = 4;
constexpr int kRowsPerStep = 128;

std::size_t pixels_of(const RenderCamera& camera) {
  return static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
}

}  // namespace

std::optional<std::string_view> Renderer::problem(const RenderScene& scene, const RenderCamera& camera) {
  if (!is_valid(packed_format(PixelFormat::gray8, camera.width_px, camera.height_px))) return "no image of this size";
  if (!(camera.height_m > 0.0 && camera.height_m < scene.ceiling_m))
    return "the camera is not between floor and ceiling";
  const Eigen::Vector2d size = scene.room.high_m - scene.room.low_m;
  if (!(size.minCoeff() >= 0.2 && size.maxCoeff() <= 1e4)) return "the room is too small or too large";
  return std::nullopt;
}

Renderer::Renderer(const RenderScene& scene, const RenderCamera& camera)
    : Renderer(scene, camera, CameraSpace{camera.height_m, scene.ceiling_m}) {}

Renderer::Renderer(const RenderScene& scene, const RenderCamera& camera, const CameraSpace& space)
    : width_px_(camera.width_px),
      height_px_(camera.height_px),
      T_body_camera_(camera.T_body_camera),
      rays_(camera.model, ImageMask(camera.model.axes(), camera.mask), camera.width_px, camera.height_px, space),
      room_(scene, space),
      cylinders_(scene, space),
      sensor_(camera.sensor, camera.model.axes(), camera.width_px, camera.height_px),
      image_(pixels_of(camera), kNothing) {
  assert(!problem(scene, camera));
}

bool Renderer::can_write(const FrameFormat& format) const {
  return is_valid(format) && format.width_px == width_px_ && format.height_px == height_px_ &&
         ImageSensor::can_write(format.pixels);
}

void Renderer::render(const Pose2& T_world_body, const FrameView& out) {
  begin(T_world_body);
  while (!step(out)) {
  }
}

void Renderer::begin(const Pose2& T_world_body) {
  T_world_camera_ = T_world_body * T_body_camera_;
  const Eigen::Vector2d inside = room_.inside(T_world_camera_.position());
  T_world_camera_.x_m = inside.x();
  T_world_camera_.y_m = inside.y();
  cylinders_.place(T_world_camera_);
  sensor_.begin_exposure();
  rays_painted_ = 0;
  rows_read_ = 0;
  stage_ = Stage::room;
}

bool Renderer::step(const FrameView& out) {
  assert(can_write(out.format) && out.bytes.size() >= out.format.bytes());
  switch (stage_) {
    case Stage::room:
      stage_ = paint_room() ? Stage::room : Stage::cylinders;
      break;
    case Stage::cylinders:
      stage_ = paint_cylinders() ? Stage::cylinders : Stage::sensor;
      break;
    case Stage::sensor:
      stage_ = read_sensor(out) ? Stage::sensor : Stage::whole;
      break;
    case Stage::whole:
      break;
  }
  return stage_ == Stage::whole;
}

// The stages return whether there is more to do.

bool Renderer::paint_room() {
  const std::size_t count = std::min(kRaysPerStep, rays_.rays().size() - rays_painted_);
  room_.paint(rays_.rays().subspan(rays_painted_, count), T_world_camera_, image_);
  rays_painted_ += count;
  return rays_painted_ < rays_.rays().size();
}

bool Renderer::paint_cylinders() { return cylinders_.paint_next(kCylindersPerStep, rays_, image_); }

bool Renderer::read_sensor(const FrameView& out) {
  const int last = std::min(rows_read_ + kRowsPerStep, height_px_);
  sensor_.read_rows(rows_read_, last, image_, out.format, out.bytes);
  rows_read_ = last;
  return last < height_px_;
}

std::optional<RenderCamera> render_camera_of(const CameraRig& rig, std::string& problem) {
  const std::optional<CameraModel> model = camera_of(rig, problem);
  if (!model) return std::nullopt;
  RenderCamera camera{.model = *model, .mask = mask_of(rig.image), .T_body_camera = {}, .sensor = {}};
  camera.width_px = rig.image.width_px.value_or(0);
  camera.height_px = rig.image.height_px.value_or(0);
  camera.height_m = rig.image.viewpoint_height_m.value_or(0.0);
  camera.T_body_camera = {rig.position_m[0], rig.position_m[1], rig.yaw_offset_rad};
  return camera;
}

}  // namespace azimuth
