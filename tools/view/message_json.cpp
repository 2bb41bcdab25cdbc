#include "tools/view/message_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace azimuth {
namespace {

using Json = nlohmann::json;

constexpr double kPerMetre = 1e4, kPerRadian = 1e5, kPerSecond = 1e3;

template <class Part>
Json column(std::span<const TrailPoint> points, double per_unit, const Part& part) {
  Json values = Json::array();
  for (const TrailPoint& point : points) values.push_back(rounded_json(part(point), per_unit));
  return values;
}

/// The columns common to estimate and truth.
Json way_json(std::span<const TrailPoint> points) {
  return {{"t", column(points, kPerSecond, [](const TrailPoint& p) { return p.t_s; })},
          {"x", column(points, kPerMetre, [](const TrailPoint& p) { return p.T_map_body.x_m; })},
          {"y", column(points, kPerMetre, [](const TrailPoint& p) { return p.T_map_body.y_m; })},
          {"heading", column(points, kPerRadian, [](const TrailPoint& p) { return p.T_map_body.heading_rad; })}};
}

Json counters_json(const status_t& s) {
  return {{"utime", s.utime},
          {"utime_mono", s.utime_mono},
          {"seq", s.seq},
          {"health", s.health},
          {"estimates", s.estimates},
          {"steps", s.steps},
          {"estimate_digest", fmt::format("{:016x}", static_cast<std::uint64_t>(s.estimate_digest))},
          {"landmarks", s.landmarks},
          {"accepted", s.accepted},
          {"rejected", s.rejected},
          {"thinned", s.thinned},
          {"created", s.created},
          {"deleted", s.deleted},
          {"recovered", s.recovered},
          {"odometry_out_of_order", s.odometry_out_of_order},
          {"bearings_out_of_order", s.bearings_out_of_order},
          {"bearings_without_odometry", s.bearings_without_odometry},
          {"values_not_finite", s.values_not_finite},
          {"odometry_gaps", s.odometry_gaps},
          {"bearing_gaps", s.bearing_gaps},
          {"odometry_refused", s.odometry_refused},
          {"bearings_refused", s.bearings_refused},
          {"frames_replaced", s.frames_replaced},
          {"estimates_replaced", s.estimates_replaced},
          {"echoes_refused", s.echoes_refused},
          {"publish_failures", s.publish_failures},
          {"frames", s.frames},
          {"frames_unusable", s.frames_unusable},
          {"detect_mean_us", number_json(s.detect_mean_us)},
          {"detect_max_us", number_json(s.detect_max_us)},
          {"odometer_reconnects", s.odometer_reconnects},
          {"camera_reconnects", s.camera_reconnects},
          {"odometer_resets", s.odometer_resets},
          {"camera_resets", s.camera_resets},
          {"camera_missing", s.camera_missing},
          {"camera_corrupt", s.camera_corrupt},
          {"record_losses", s.record_losses},
          {"battery_v", number_json(s.battery_v)},
          {"robot_flags", s.robot_flags}};
}

}  // namespace

Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json rounded_json(double value, double per_unit) {
  if (!std::isfinite(value)) return nullptr;
  return std::round(value * per_unit) / per_unit + 0.0;  // turns -0 into 0
}

Json pose_json(const pose_cov_t& pose) {
  const double* const P = pose.covariance;
  return {{"seq", pose.seq},
          {"step", pose.step},
          {"predicted", pose.predicted != 0},
          {"x", pose.x_m},
          {"y", pose.y_m},
          {"heading", pose.heading_rad},
          {"covariance", {P[0], P[1], P[2], P[4], P[5], P[8]}},
          {"odom", {pose.odom_x_m, pose.odom_y_m, pose.odom_heading_rad}},
          {"health", pose.health}};
}

Json status_json(const status_t& status, std::size_t most_bytes) {
  Json json = counters_json(status);
  const auto add = [&](const char* name, const std::string& text) { json[name] = shortened(text, most_bytes); };
  add("reason", status.reason);
  add("image_trouble", status.image_trouble);
  add("input_trouble", status.input_trouble);
  add("map_trouble", status.map_trouble);
  add("picture_trouble", status.picture_trouble);
  add("odometer", status.odometer);
  add("camera", status.camera);
  add("recorder", status.recorder);
  add("realtime", status.realtime);
  add("configuration", status.configuration);
  return json;
}

Json kept_json(const kept_t& kept, std::int64_t wall_us) {
  const auto some = [](bool is_some, std::int64_t value) { return is_some ? Json(value) : Json(nullptr); };
  const double age_s = 1e-6 * static_cast<double>(std::max<std::int64_t>(0, wall_us - kept.map_utime));
  return {{"log_bytes", some(kept.log_size >= 0, kept.log_size)},
          {"log_quota_bytes", some(kept.log_size >= 0 && kept.log_quota > 0, kept.log_quota)},
          {"disk_free_bytes", some(kept.disk_free >= 0, kept.disk_free)},
          {"map_age_s", kept.map_utime != 0 ? rounded_json(age_s, 10.0) : Json(nullptr)}};
}

Json truth_trail_json(std::span<const TrailPoint> points) { return way_json(points); }

namespace {

/// The relation between image axes and azimuths in the robot's frame (slam/camera/image_axes.hpp); null for missing
/// values.
Json image_json(const CameraRig& camera) {
  const ImageRig& image = camera.image;
  const auto some = [](const auto& value) { return value ? Json(*value) : Json(nullptr); };
  return {{"width", some(image.width_px)},        {"height", some(image.height_px)},
          {"centre", some(image.centre_px)},      {"beta", image.beta},
          {"direction", image.azimuth_direction}, {"offset", image.azimuth_offset_rad + camera.yaw_offset_rad},
          {"inner", some(image.mask_inner_px)},   {"outer", some(image.mask_outer_px)}};
}

}  // namespace

Json rig_json(const Rig& rig) {
  constexpr std::array<std::string_view, 4> kFrontEnds{"bearings", "colour", "sift", "lamps"};
  return {{"front_end", kFrontEnds.at(static_cast<std::size_t>(rig.front_end))},
          {"camera_model", name(rig.camera.model)},
          {"looks_up", looks_up(rig.camera.model)},
          {"identities", rig.camera.identities},
          {"field_of_view_rad", rig.camera.field_of_view_rad},
          {"position_m", rig.camera.position_m},
          {"yaw_offset_rad", rig.camera.yaw_offset_rad},
          {"azimuths_clockwise", rig.camera.azimuths_clockwise},
          {"sigma_bearing_rad", rig.camera.sigma_bearing_rad},
          {"image", image_json(rig.camera)}};
}

Json trail_json(std::span<const TrailPoint> points) {
  Json json = way_json(points);
  json["health"] = Json::array();
  for (const TrailPoint& point : points) json["health"].push_back(point.health);
  json["sigma_m"] = column(points, kPerMetre, [](const TrailPoint& p) { return double{p.sigma_m}; });
  json["sigma_heading_rad"] =
      column(points, kPerRadian, [](const TrailPoint& p) { return double{p.sigma_heading_rad}; });
  json["odom_x"] = column(points, kPerMetre, [](const TrailPoint& p) { return p.T_odom_body.x_m; });
  json["odom_y"] = column(points, kPerMetre, [](const TrailPoint& p) { return p.T_odom_body.y_m; });
  json["odom_heading"] = column(points, kPerRadian, [](const TrailPoint& p) { return p.T_odom_body.heading_rad; });
  return json;
}

std::string shortened(std::string_view text, std::size_t most_bytes) {
  if (text.size() <= most_bytes) return std::string(text);
  std::size_t end = most_bytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // skips UTF-8 continuation bytes
  return std::string(text.substr(0, end)) + "...";
}

}  // namespace azimuth
