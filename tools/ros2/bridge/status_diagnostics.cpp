#include "tools/ros2/bridge/status_diagnostics.hpp"

#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>

#include "drivers/estimates/estimate_messages.hpp"
#include "drivers/ros/make_messages.hpp"

namespace azimuth {
namespace {

using ros::DiagnosticStatus;

DiagnosticStatus named(const char* name) {
  DiagnosticStatus status;
  status.name = std::string("azimuth: ") + name;
  status.hardware_id = "azimuth";
  status.message = "ok";
  return status;
}

void add(DiagnosticStatus& status, const char* key, std::int64_t value) {
  status.values.push_back({key, std::to_string(value)});
}

void add(DiagnosticStatus& status, const char* key, const std::string& value) {
  if (!value.empty()) status.values.push_back({key, value});
}

/// Sets a warning with each sentence that is not empty.
void warn(DiagnosticStatus& status, std::initializer_list<std::string> troubles) {
  for (const std::string& trouble : troubles) {
    if (trouble.empty()) continue;
    status.message = status.level == DiagnosticStatus::kOk ? trouble : status.message + "; " + trouble;
    status.level = DiagnosticStatus::kWarn;
  }
}

DiagnosticStatus pose_of(const status_t& status) {
  DiagnosticStatus pose = ros::health_status(health_of(status.health).value_or(Health::lost), status.reason);
  add(pose, "landmarks", status.landmarks);
  add(pose, "steps", status.steps);
  add(pose, "bearings accepted", status.accepted);
  add(pose, "bearings rejected", status.rejected);
  return pose;
}

DiagnosticStatus input_of(const status_t& status) {
  DiagnosticStatus input = named("input");
  warn(input, {status.input_trouble, status.image_trouble.empty() ? "" : "images: " + status.image_trouble});
  add(input, "images", status.frames);
  add(input, "images of no use", status.frames_unusable);
  add(input, "bearings without odometry", status.bearings_without_odometry);
  add(input, "odometry gaps", status.odometry_gaps);
  add(input, "bearing gaps", status.bearing_gaps);
  return input;
}

DiagnosticStatus devices_of(const status_t& status) {
  DiagnosticStatus devices = named("devices");
  add(devices, "odometer", status.odometer);
  add(devices, "camera", status.camera);
  add(devices, "odometer reconnects", status.odometer_reconnects);
  add(devices, "camera reconnects", status.camera_reconnects);
  add(devices, "images missing", status.camera_missing);
  if (std::isfinite(status.battery_v)) add(devices, "battery [V]", std::to_string(status.battery_v));
  for (const auto& [name, text] : {std::pair{"odometer: ", &status.odometer}, std::pair{"camera: ", &status.camera}})
    if (!text->empty() && !text->starts_with("running")) warn(devices, {name + *text});
  const auto has = [&status](std::int32_t flag) { return (status.robot_flags & flag) != 0; };
  if (has(status_t::ROBOT_EMERGENCY_STOP)) warn(devices, {"emergency stop"});
  if (has(status_t::ROBOT_STALL_LEFT) || has(status_t::ROBOT_STALL_RIGHT)) warn(devices, {"a wheel stalls"});
  if (has(status_t::ROBOT_BUMPER)) warn(devices, {"a bumper is pressed"});
  return devices;
}

DiagnosticStatus process_of(const status_t& status) {
  DiagnosticStatus process = named("process");
  warn(process, {status.configuration, status.map_trouble, status.picture_trouble});
  add(process, "recorder", status.recorder);
  add(process, "realtime", status.realtime);
  add(process, "events not recorded", status.record_losses);
  add(process, "messages not sent", status.publish_failures);
  return process;
}

}  // namespace

std::vector<DiagnosticStatus> diagnostics_of(const status_t& status) {
  return {pose_of(status), input_of(status), devices_of(status), process_of(status)};
}

}  // namespace azimuth
