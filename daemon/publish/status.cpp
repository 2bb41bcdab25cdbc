#include "daemon/publish/status.hpp"

#include <cmath>
#include <fmt/format.h>

#include "settings/sample_sentence.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

/// Time without odometry after which the pose is lost: the robot may be anywhere in a room by then.
constexpr std::chrono::seconds kBlind{5};

std::string what_is_in_trouble(const Status& status) {
  std::string text;
  const auto add = [&text](const char* name, const DeviceStatus& device) {
    if (device.is_away()) text += fmt::format("  {}: {}", name, device.text);
  };
  add("odometer", status.odometer);
  add("camera", status.camera);
  if (status.samples.trouble != SampleTrouble::none) text += "  samples: " + sentence(status.samples);
  if (!status.pace.empty()) text += "  pace: " + status.pace;
  if (status.map.trouble) text += "  map: " + status.map.text;
  if (!status.picture.empty()) text += "  picture: " + status.picture;
  if (status.process.realtime_refused) text += "  realtime: " + status.process.realtime;
  if (!status.process.configuration.empty()) text += "  configuration: " + status.process.configuration;
  return text;
}

std::string health_text(const ToldHealth& told) {
  return fmt::format("{}{}{}", to_string(told.health), told.reason.empty() ? "" : ": ", told.reason);
}

std::string pose_text(const Estimate& estimate) {
  const Pose2& pose = estimate.T_map_body;
  const double sigma_m = std::sqrt(estimate.pose_covariance(0, 0) + estimate.pose_covariance(1, 1));
  return fmt::format("x {:.2f} y {:.2f} m  heading {:.1f} deg  +-{:.2f} m", pose.x_m, pose.y_m,
                     rad_to_degrees(pose.heading_rad), sigma_m);
}

}  // namespace

std::uint64_t Status::samples_lost() const {
  const InputCounts& input = estimate.input;
  return wires.odometry_refused + wires.bearings_refused + input.odometry_out_of_order + input.bearings_out_of_order +
         input.bearings_without_odometry + input.odometry_gaps + input.bearing_gaps;
}

ToldHealth told_health(const Estimate& estimate, const DeviceStatus& odometer, const DeviceStatus& camera) {
  ToldHealth told{estimate.health, estimate.reason};
  if (told.health == Health::lost || (!odometer.is_away() && !camera.is_away())) return told;
  told.reason = odometer.is_away() ? "no odometry" : "no images";
  if (told.health == Health::starting) return told;
  told.health = odometer.is_away() && odometer.away > kBlind ? Health::lost : Health::degraded;
  return told;
}

std::string duration_text(std::chrono::seconds duration) {
  const auto seconds = duration.count();
  if (seconds < 60) return fmt::format("{} s", seconds);
  if (seconds < 3600) return fmt::format("{} min {:02} s", seconds / 60, seconds % 60);
  if (seconds < 86400) return fmt::format("{} h {:02} min", seconds / 3600, seconds / 60 % 60);
  return fmt::format("{} d {:02} h", seconds / 86400, seconds / 3600 % 24);
}

std::string pose_line(const Estimate& estimate) {
  return fmt::format("t {:.3f} s  {}  {}", to_seconds(estimate.stamp), health_text({estimate.health, estimate.reason}),
                     pose_text(estimate));
}

std::string status_line(const Status& status, std::chrono::seconds uptime) {
  const std::string up = "up " + duration_text(uptime), trouble = what_is_in_trouble(status);
  if (!status.any_estimate)
    return fmt::format("{}  no estimate yet{}  {} samples lost", up, trouble, status.samples_lost());
  const AssociationCounts& association = status.estimate.association;
  return fmt::format("{}  {}{}  {}  {} landmarks  {} accepted {} rejected  {} lost", up,
                     health_text(told_health(status.estimate, status.odometer, status.camera)), trouble,
                     pose_text(status.estimate), status.landmarks, association.accepted, association.rejected,
                     status.samples_lost());
}

}  // namespace azimuth
