#include "tests/support/room_views.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "sim/renderer/renderer.hpp"
#include "sim/renderer/standard_cameras.hpp"
#include "slam/camera/make_camera.hpp"
#include "slam/geometry/angle.hpp"
#include "slam/perception/sift/sift_settings.hpp"

namespace azimuth::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kToWall_m = 1.0, kToCylinder_m = 0.5;  // least distances of a camera
constexpr double kNear_px = 3.0, kMuchLarger = 2.0;     // in a working square of 480 px
constexpr double kHiddenBy_m = 0.05, kNever_m = std::numeric_limits<double>::infinity();

bool is_free(const RenderScene& scene, const Vector2d& place) {
  return ((place - scene.room.low_m).array() > kToWall_m).all() &&
         ((scene.room.high_m - place).array() > kToWall_m).all() &&
         std::ranges::none_of(scene.cylinders, [&](const RenderCylinder& cylinder) {
           return (cylinder.p_world_m - place).norm() < cylinder.radius_m + kToCylinder_m;
         });
}

Pose2 free_pose(const RenderScene& scene, Random& random) {
  for (;;) {
    const Pose2 pose{random.uniform(scene.room.low_m.x(), scene.room.high_m.x()),
                     random.uniform(scene.room.low_m.y(), scene.room.high_m.y()), random.uniform(-kPi, kPi)};
    if (is_free(scene, pose.position())) return pose;
  }
}

Pose2 free_pose_near(const RenderScene& scene, const Pose2& other, double apart_m, Random& random) {
  for (;;) {
    const double towards_rad = random.uniform(-kPi, kPi);
    const Pose2 pose{other.x_m + apart_m * std::cos(towards_rad), other.y_m + apart_m * std::sin(towards_rad),
                     random.uniform(-kPi, kPi)};
    if (is_free(scene, pose.position())) return pose;
  }
}

RoomImage rendered(Renderer& renderer, const RenderCamera& camera, const Pose2& T_world_body, double light) {
  const FrameFormat format = packed_format(PixelFormat::gray8, camera.width_px, camera.height_px);
  RoomImage image{T_world_body, format, std::vector<std::byte>(format.bytes())};
  renderer.render(T_world_body, {format, image.bytes});
  for (std::byte& byte : image.bytes)
    byte = static_cast<std::byte>(std::lround(std::min(255.0, light * std::to_integer<int>(byte))));
  return image;
}

/// Distance along a ray of unit length to the inner faces of the room.
double to_faces_m(const RenderScene& scene, const Vector3d& from, const Vector3d& ray) {
  const Vector3d low{scene.room.low_m.x(), scene.room.low_m.y(), 0.0};
  const Vector3d high{scene.room.high_m.x(), scene.room.high_m.y(), scene.ceiling_m};
  double nearest_m = kNever_m;
  for (int axis = 0; axis < 3; ++axis)
    if (ray[axis] != 0.0)
      nearest_m = std::min(nearest_m, ((ray[axis] > 0.0 ? high : low)[axis] - from[axis]) / ray[axis]);
  return nearest_m;
}

/// Distance along a ray to the side of the cylinder. The lid is neglected.
double to_side_m(const RenderCylinder& cylinder, const Vector3d& from, const Vector3d& ray) {
  const Vector2d away = from.head<2>() - cylinder.p_world_m, along = ray.head<2>();
  const double a = along.squaredNorm(), b = away.dot(along);
  const double root = b * b - a * (away.squaredNorm() - cylinder.radius_m * cylinder.radius_m);
  if (a == 0.0 || root < 0.0) return kNever_m;
  const double distance_m = (-b - std::sqrt(root)) / a, up_m = from.z() + distance_m * ray.z();
  return distance_m > 0.0 && up_m >= cylinder.low_m && up_m <= cylinder.high_m ? distance_m : kNever_m;
}

Eigen::AngleAxisd turn(const Pose2& pose) { return Eigen::AngleAxisd(pose.heading_rad, Vector3d::UnitZ()); }

CameraModel model_of(const CameraRig& rig) {
  std::string problem;
  return *camera_of(rig, problem);
}

}  // namespace

RoomPairs room_pairs(std::uint64_t seed, const RoomPairSettings& settings) {
  RoomPairs room{*standard_camera("mirror"), coloured_scene(lab(seed)), {}};
  std::string problem;
  RenderCamera camera = *render_camera_of(room.rig, problem);
  camera.sensor.noise = settings.noise;
  Renderer renderer(room.scene, camera);
  Random random(seed, RandomPurpose::drive);
  for (int i = 0; i < settings.count; ++i) {
    const double apart_m = random.uniform(settings.least_m, settings.most_m);
    const Pose2 first = free_pose(room.scene, random), second = free_pose_near(room.scene, first, apart_m, random);
    room.pairs.push_back(
        {rendered(renderer, camera, first, 1.0), rendered(renderer, camera, second, settings.light), apart_m});
  }
  return room;
}

KnownRoom::KnownRoom(const RoomPairs& room)
    : scene_(room.scene),
      rig_(room.rig),
      square_(working_square(axes_of(rig_.image), *rig_.image.mask_outer_px, SiftSettings{}.side_px)) {}

Vector3d KnownRoom::hit(const Vector3d& from, const Vector3d& ray) const {
  double distance_m = to_faces_m(scene_, from, ray);
  for (const RenderCylinder& cylinder : scene_.cylinders)
    distance_m = std::min(distance_m, to_side_m(cylinder, from, ray));
  return from + distance_m * ray;
}

std::optional<Vector2d> KnownRoom::moved(const RoomPair& pair, double x_px, double y_px) const {
  const CameraModel model = model_of(rig_);
  const double height_m = *rig_.image.viewpoint_height_m;
  const auto eye = [&](const Pose2& pose) { return Vector3d(pose.x_m, pose.y_m, height_m); };
  const auto ray = model.ray(square_.camera_pixel(x_px, y_px));
  if (!ray) return std::nullopt;
  const Pose2 &first = pair.first.T_world_body, &second = pair.second.T_world_body;
  const Vector3d there = hit(eye(first), turn(first) * *ray), towards = there - eye(second);
  if ((hit(eye(second), towards.normalized()) - there).norm() > kHiddenBy_m) return std::nullopt;
  const auto pixel = model.pixel(Vector3d(turn(second).inverse() * towards));
  if (!pixel || !ImageMask(square_.axes, mask_of(rig_.image)).visible(*pixel)) return std::nullopt;
  const Vector2d from_centre{pixel->x() - square_.axes.centre_px.x(),
                             pixel->y() / square_.axes.beta - square_.axes.centre_px.y()};
  return Vector2d::Constant(square_.middle_px()) + square_.scale * from_centre;
}

std::optional<ImagePlace> KnownRoom::seen_again(const RoomPair& pair, const ImagePlace& place) const {
  constexpr double kStep_px = 0.1;
  const auto here = moved(pair, place.x_px, place.y_px);
  const auto right = moved(pair, place.x_px + kStep_px, place.y_px),
             below = moved(pair, place.x_px, place.y_px + kStep_px);
  if (!here || !right || !below) return std::nullopt;
  Eigen::Matrix2d sides;
  sides << *right - *here, *below - *here;
  return ImagePlace{here->x(), here->y(), place.sigma_px * std::sqrt(std::abs(sides.determinant())) / kStep_px};
}

bool is_seen_at(const ImagePlace& expected, const ImagePlace& feature) {
  const double off_px = std::hypot(expected.x_px - feature.x_px, expected.y_px - feature.y_px);
  return off_px < std::max(kNear_px, expected.sigma_px) && feature.sigma_px < kMuchLarger * expected.sigma_px &&
         expected.sigma_px < kMuchLarger * feature.sigma_px;
}

}  // namespace azimuth::test
