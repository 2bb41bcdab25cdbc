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

constexpr std::chrono::seconds kWindow{5};
constexpr double kMany = 0.1;          // fraction of skipped samples from which on the skipping is reported
constexpr std::uint64_t kEnough = 10;  // samples needed for a judgement

double interval_ms(double window_s, std::uint64_t count) { return 1e3 * window_s / static_cast<double>(count); }

bool are_many(std::uint64_t left_out, std::uint64_t came) {
  return came >= kEnough && static_cast<double>(left_out) > kMany * static_cast<double>(came);
}

int percent(std::uint64_t part, std::uint64_t whole) {
  return static_cast<int>(100.0 * static_cast<double>(part) / static_cast<double>(whole) + 0.5);
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

void PaceWatch::look(Clock::time_point now, const Status& status) {
  const Counts counts{now, status.perception.frames, status.wires.frames_replaced, status.wires.bearings_refused,
                      status.estimate.step};
  if (before_.at == Clock::time_point{}) before_ = counts;
  if (now - before_.at < kWindow) return;
  text_ = judged(before_, counts, status.perception.detect_mean_us);
  before_ = counts;
}

std::string PaceWatch::judged(const Counts& before, const Counts& now, double detect_mean_us) {
  const double window_s = std::chrono::duration<double>(now.at - before.at).count();
  const std::uint64_t looked = now.looked - before.looked, replaced = now.replaced - before.replaced;
  const std::uint64_t refused = now.refused - before.refused, steps = now.steps - before.steps;
  if (are_many(replaced, looked + replaced))
    return fmt::format(
        "images come every {:.0f} ms and are worked off every {:.0f} ms, of which finding bearings takes {:.0f} ms: "
        "{} % are left out; ask the camera for fewer or smaller ones (rate_hz), or give the estimator less to do",
        interval_ms(window_s, looked + replaced), interval_ms(window_s, looked > 0 ? looked : 1), 1e-3 * detect_mean_us,
        percent(replaced, looked + replaced));
  if (are_many(refused, steps + refused))
    return fmt::format(
        "bearings come every {:.0f} ms and a step takes {:.0f} ms: {} % are left out; send fewer, or give the "
        "estimator less to do (docs/tuning.md)",
        interval_ms(window_s, steps + refused), interval_ms(window_s, steps > 0 ? steps : 1),
        percent(refused, steps + refused));
  return {};
}

}  // namespace azimuth
