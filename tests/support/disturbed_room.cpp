#include "tests/support/disturbed_room.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "slam/camera/make_camera.hpp"
#include "slam/geometry/angle.hpp"
#include "slam/geometry/motion.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth::test {
namespace {

constexpr double kShoulders_m = 0.45;
constexpr double kNearest_m = 0.4;
constexpr double kInRoom_m = 2.5;
/// One part of a person, from the floor up: legs, jacket, head.
struct Layer {
  double low_m, high_m, width_m;
};
constexpr std::array<Layer, 3> kLayers{{{0.0, 0.85, 0.30}, {0.85, 1.45, kShoulders_m}, {1.45, 1.75, 0.18}}};

/// Direction in which one pixel looks.
struct Ray {
  float azimuth_rad = std::numeric_limits<float>::quiet_NaN();
  float elevation_rad = 0.0F;
};

class DisturbedRoom {
 public:
  DisturbedRoom(RoomTrouble trouble, const Run& run, const CameraRig& rig) : trouble_(std::move(trouble)), rig_(rig) {
    for (const FrameFile& frame : run.frames) {
      stamps_s_.push_back(to_seconds(frame.stamp - run.frames.front().stamp));
      cameras_.push_back(pose_at(run.truth, frame.stamp));
    }
  }

  void operator()(const FrameFormat& format, std::vector<std::byte>& pixels, int image) {
    if (rays_.empty()) cast_rays(format);
    const auto at = static_cast<std::size_t>(image);
    const Pose2& T_world_camera = cameras_[at];
    darken(format, pixels, image, T_world_camera);
    for (const Walker& walker : trouble_.people)
      paint(format, pixels, walker, walker.at(stamps_s_[at]), T_world_camera);
  }

 private:
  static Pose2 pose_at(const std::vector<TruthPose>& truth, Stamp stamp) {
    const auto after = std::ranges::lower_bound(truth, stamp, {}, &TruthPose::stamp);
    if (after == truth.end()) return truth.back().T_world_body;
    if (after == truth.begin() || after->stamp == stamp) return after->T_world_body;
    const double fraction = to_seconds(stamp - (after - 1)->stamp) / to_seconds(after->stamp - (after - 1)->stamp);
    return interpolate((after - 1)->T_world_body, after->T_world_body, fraction);
  }

  void cast_rays(const FrameFormat& format) {
    std::string problem;
    CameraRig sized = rig_;
    sized.image.width_px = format.width_px;
    sized.image.height_px = format.height_px;
    const auto camera = camera_of(sized, problem);
    rays_.resize(static_cast<std::size_t>(format.width_px * format.height_px));
    if (!camera) return;
    for (int v = 0; v < format.height_px; ++v)
      for (int u = 0; u < format.width_px; ++u)
        if (const auto direction = camera->direction({static_cast<double>(u), static_cast<double>(v)}))
          rays_[static_cast<std::size_t>(v * format.width_px + u)] = {static_cast<float>(direction->azimuth_rad),
                                                                      static_cast<float>(direction->elevation_rad)};
  }

  double light(int image) const {
    const double phase = 2.0 * kPi * image / trouble_.dimming_images;
    return trouble_.dimmest + (1.0 - trouble_.dimmest) * (0.5 + 0.5 * std::cos(phase));
  }

  /// Darkness at the place that the pixel shows: 0 at the bright end of the room, 1 at the dark end.
  double darkness_at(const Pose2& T_world_camera, const Ray& ray) const {
    const double away_m = trouble_.ceiling_m > 0.0
                              ? trouble_.ceiling_m / std::tan(std::max(static_cast<double>(ray.elevation_rad), 0.2))
                              : kInRoom_m;
    const double direction_rad = T_world_camera.heading_rad + ray.azimuth_rad, dark_rad = trouble_.dark_towards_rad;
    const Eigen::Vector2d p =
        T_world_camera.position() + away_m * Eigen::Vector2d(std::cos(direction_rad), std::sin(direction_rad));
    const double along_m = p.dot(Eigen::Vector2d(std::cos(dark_rad), std::sin(dark_rad)));
    return std::clamp(0.5 + 0.5 * along_m / trouble_.room_m, 0.0, 1.0);
  }

  void darken(const FrameFormat& format, std::vector<std::byte>& pixels, int image, const Pose2& T_world_camera) const {
    const double everywhere = light(image), side = trouble_.darker_side;
    if (everywhere == 1.0 && side == 1.0) return;
    const int channels = bytes_per_pixel(format.pixels);
    for (int v = 0; v < format.height_px; ++v)
      for (int u = 0; u < format.width_px; ++u) {
        const Ray& ray = rays_[static_cast<std::size_t>(v * format.width_px + u)];
        if (std::isnan(ray.azimuth_rad)) continue;
        const double gain = everywhere * (1.0 - (1.0 - side) * darkness_at(T_world_camera, ray));
        for (int c = 0; c < channels; ++c) {
          std::byte& value = pixels[static_cast<std::size_t>(v * format.stride_bytes + u * channels + c)];
          value = static_cast<std::byte>(std::lround(gain * std::to_integer<int>(value)));
        }
      }
  }

  void paint(const FrameFormat& format, std::vector<std::byte>& pixels, const Walker& walker,
             const Eigen::Vector2d& p_world, const Pose2& T_world_camera) const {
    const Eigen::Vector2d p = inverse(T_world_camera) * p_world;
    const double distance_m = std::max(p.norm(), kNearest_m), towards_rad = std::atan2(p.y(), p.x());
    const double camera_m = rig_.image.viewpoint_height_m.value_or(1.0);
    const int channels = bytes_per_pixel(format.pixels);
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const Ray& ray = rays_[i];
      if (std::isnan(ray.azimuth_rad)) continue;
      const double aside_m = distance_m * std::tan(std::clamp(wrap(ray.azimuth_rad - towards_rad), -1.5, 1.5));
      const double height_m = camera_m + distance_m * std::tan(static_cast<double>(ray.elevation_rad));
      for (std::size_t layer = 0; layer < kLayers.size(); ++layer) {
        const Layer& part = kLayers[layer];
        if (height_m < part.low_m || height_m >= part.high_m || std::abs(aside_m) > 0.5 * part.width_m) continue;
        const auto v = static_cast<int>(i) / format.width_px, u = static_cast<int>(i) % format.width_px;
        const double shade = 1.0 - 0.4 * std::abs(aside_m) / (0.5 * part.width_m);
        const std::array<std::array<int, 3>, 3> colours{
            {{35, 35, 45}, {walker.red, walker.green, walker.blue}, {190, 140, 115}}};
        for (int c = 0; c < channels; ++c)
          pixels[static_cast<std::size_t>(v * format.stride_bytes + u * channels + c)] =
              static_cast<std::byte>(std::lround(shade * colours[layer][static_cast<std::size_t>(c)]));
      }
    }
  }

  RoomTrouble trouble_;
  CameraRig rig_;
  std::vector<double> stamps_s_;
  std::vector<Pose2> cameras_;
  std::vector<Ray> rays_;
};

}  // namespace

Eigen::Vector2d Walker::at(double t_s) const {
  const double way_s = (to_m - from_m).norm() / speed_m_per_s, round_s = 2.0 * (way_s + rest_s);
  const double t = std::fmod(t_s + phase_s, round_s);
  const double there = std::clamp((t - rest_s) / way_s, 0.0, 1.0);
  const double back = std::clamp((t - 2.0 * rest_s - way_s) / way_s, 0.0, 1.0);
  return from_m + (there - back) * (to_m - from_m);
}

Spoil spoil_of(const RoomTrouble& trouble, const Run& run, const CameraRig& rig) {
  return DisturbedRoom(trouble, run, rig);
}

Run with_scaled_odometry(Run run, double factor) {
  const Pose2 start = run.odometry.front().T_odom_body;
  for (OdometryReading& reading : run.odometry) {
    Pose2& pose = reading.T_odom_body;
    pose.x_m = start.x_m + factor * (pose.x_m - start.x_m);
    pose.y_m = start.y_m + factor * (pose.y_m - start.y_m);
  }
  return run;
}

Run with_drawn_odometry(Run run, const OdometryRig& rig, unsigned seed) {
  RandomDraws draws(seed);
  const MotionNoise noise{rig.lambda_distance_m, rig.lambda_rotation_rad, rig.lambda_drift_rad2_per_m,
                          rig.sigma_lateral_m_per_sqrt_m};
  OdometryReading reading = run.odometry.front();
  run.odometry.clear();
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    reading.stamp = run.truth[i].stamp;
    if (i > 0) {
      Control control = control_between(run.truth[i - 1].T_world_body, run.truth[i].T_world_body);
      const Eigen::Vector4d sigmas = control_variances(control, noise).cwiseSqrt();
      control.distance_m += draws.normal(sigmas(0));
      control.first_turn_rad += draws.normal(sigmas(1));
      control.second_turn_rad += draws.normal(sigmas(2)) + draws.normal(sigmas(3));
      reading.T_odom_body = move(reading.T_odom_body, control);
    }
    run.odometry.push_back(reading);
  }
  return run;
}

}  // namespace azimuth::test
