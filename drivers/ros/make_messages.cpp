#include "drivers/ros/make_messages.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/geometry/principal_axes.hpp"

namespace azimuth::ros {
namespace {

constexpr double kLongestStep_s = 1.0;
// Sizes of the markers.
constexpr double kSphere_m = 0.1, kDisc_m = 0.01, kLetters_m = 0.15;
constexpr Colour kSphereColour{0.1F, 0.4F, 0.9F, 1.0F}, kDiscColour{0.1F, 0.4F, 0.9F, 0.25F},
    kNameColour{1.0F, 1.0F, 1.0F, 1.0F};

Quaternion about_z(double angle_rad) { return {0.0, 0.0, std::sin(0.5 * angle_rad), std::cos(0.5 * angle_rad)}; }

/// Inserts the covariance of (x, y, heading) into that of x, y, z and three rotations. A robot on the floor has no
/// others.
Covariance planar(const Eigen::Matrix3d& P) {
  constexpr std::array<std::size_t, 3> kPlaces{0, 1, 5};
  Covariance covariance{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      covariance[6 * kPlaces[row] + kPlaces[column]] =
          P(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
  return covariance;
}

double height(const LandmarkEstimate& landmark) {
  return std::isfinite(landmark.z_map_landmark_m) ? landmark.z_map_landmark_m : 0.0;
}

std::string name_of(const LandmarkEstimate& landmark) {
  return landmark.identity != kUnknownIdentity ? std::to_string(landmark.identity) : '#' + std::to_string(landmark.id);
}

Vector3 place_of(const LandmarkEstimate& landmark) {
  return {landmark.p_map_landmark_m.x(), landmark.p_map_landmark_m.y(), height(landmark)};
}

/// Makes the ellipse four standard deviations wide, and never of zero size, which viewers refuse.
void shape_uncertainty(const LandmarkEstimate& landmark, Marker& marker) {
  const PrincipalAxes axes = principal_axes(landmark.covariance_m2);
  const auto width = [](double variance) { return std::max(4.0 * std::sqrt(std::max(variance, 0.0)), 1e-3); };
  const Eigen::Vector2d major = axes.directions.col(1);
  const double sigma_z_m = std::isfinite(landmark.sigma_z_m) ? landmark.sigma_z_m : 0.0;
  marker.scale = {width(axes.eigenvalues(1)), width(axes.eigenvalues(0)), std::max(4.0 * sigma_z_m, kDisc_m)};
  marker.pose.orientation = about_z(std::atan2(major.y(), major.x()));
}

}  // namespace

Pose to_pose(const Pose2& pose, double z_m) { return {{pose.x_m, pose.y_m, z_m}, about_z(pose.heading_rad)}; }

PoseWithCovarianceStamped pose_message(const Frames& frames, Stamp stamp, const Pose2& T_map_body,
                                       const Eigen::Matrix3d& covariance) {
  return {{stamp, frames.map}, to_pose(T_map_body), planar(covariance)};
}

Twist velocity_between(const TimedPose& before, const TimedPose& after) {
  const double dt_s = to_seconds(after.stamp - before.stamp);
  if (!(dt_s > 0.0) || dt_s > kLongestStep_s) return {};
  const Pose2 step = inverse(before.pose) * after.pose;
  const double c = std::cos(0.5 * step.heading_rad), s = std::sin(0.5 * step.heading_rad);  // half of the arc's turn
  return {{(c * step.x_m + s * step.y_m) / dt_s, (c * step.y_m - s * step.x_m) / dt_s, 0.0},
          {0.0, 0.0, step.heading_rad / dt_s}};
}

Odometry odometry_message(const Frames& frames, const std::optional<TimedPose>& before, const TimedPose& now) {
  Odometry message{.header = {now.stamp, frames.odom},
                   .child_frame_id = frames.base,
                   .pose = to_pose(now.pose),
                   .pose_covariance = {},
                   .twist = {},
                   .twist_covariance = {}};
  if (before) message.twist = velocity_between(*before, now);
  return message;
}

TransformMessage transform_message(const Frames& frames, Stamp stamp, const Pose2& T_map_body, const Pose2& T_odom_body,
                                   bool with_base) {
  TransformMessage message;
  message.transforms.push_back({{stamp, frames.map}, frames.odom, to_pose(T_map_body * inverse(T_odom_body))});
  if (with_base) message.transforms.push_back({{stamp, frames.odom}, frames.base, to_pose(T_odom_body)});
  return message;
}

Path path_message(const Frames& frames, Stamp stamp, std::span<const PathPose> path) {
  Path message{{stamp, frames.map}, {}};
  message.poses.reserve(path.size());
  for (const PathPose& pose : path) message.poses.push_back({{pose.stamp, frames.map}, to_pose(pose.T_map_body)});
  return message;
}

MarkerArray landmark_markers(const Frames& frames, Stamp stamp, std::span<const LandmarkEstimate> landmarks) {
  MarkerArray message;
  message.markers.reserve(1 + 3 * landmarks.size());
  Marker blank;
  blank.header = {stamp, frames.map};
  message.markers.push_back(blank);
  message.markers.back().action = Marker::kDeleteAll;
  const auto add = [&](const char* ns, std::int32_t type, const Colour& colour) -> Marker& {
    Marker& marker = message.markers.emplace_back(blank);
    marker.ns = ns;
    marker.type = type;
    marker.color = colour;
    return marker;
  };
  for (const LandmarkEstimate& landmark : landmarks) {
    blank.pose.position = place_of(landmark);
    add("landmarks", Marker::kSphere, kSphereColour).scale = {kSphere_m, kSphere_m, kSphere_m};
    shape_uncertainty(landmark, add("uncertainty", Marker::kCylinder, kDiscColour));
    Marker& name = add("names", Marker::kText, kNameColour);
    name.text = name_of(landmark);
    name.scale.z = kLetters_m;
    name.pose.position.z += kSphere_m + kLetters_m;
    ++blank.id;
  }
  return message;
}

DiagnosticStatus health_status(Health health, std::string_view reason) {
  DiagnosticStatus status;
  status.name = "azimuth: pose";
  status.hardware_id = "azimuth";
  status.level = health == Health::tracking ? DiagnosticStatus::kOk
                 : health == Health::lost   ? DiagnosticStatus::kError
                                            : DiagnosticStatus::kWarn;
  status.message = to_string(health);
  if (!reason.empty()) status.message.append(": ").append(reason);
  status.values.push_back({"health", std::string(to_string(health))});
  return status;
}

}  // namespace azimuth::ros
