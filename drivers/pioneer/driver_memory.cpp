// The state that outlives the driver, so that the next driver continues the same session.

#include <utility>

#include "drivers/device/device_clock.hpp"
#include "drivers/pioneer/driver.hpp"

namespace azimuth {
namespace {

constexpr std::string_view kOdometer = "pioneer ";
constexpr std::size_t kX = 0, kY = 1, kHeading = 2, kStartBaud = 3, kBaud = 4;  // indices in OdometerMemory::numbers

bool is_of(const std::string& odometer, const std::string& device) {
  return odometer.starts_with(kOdometer) && odometer.substr(kOdometer.size()) == device;
}

/// Name and subclass, one line each.
pioneer::RobotName named(const std::string& robot) {
  const std::size_t end = robot.find('\n');
  return {.name = robot.substr(0, end),
          .robot_class = {},
          .subclass = end == std::string::npos ? "" : robot.substr(end + 1)};
}

}  // namespace

bool PioneerDriver::remember(OdometerMemory& out) const {
  const auto session = session_.memory();
  const auto counters = odometer_.memory();
  if (!session || !counters) return false;
  out.odometer.assign(kOdometer).append(settings_.device);
  out.robot.assign(session->robot.name).append(1, '\n').append(session->robot.subclass);
  out.origin = counters->origin;
  out.at = stamp_at(counters->at, epoch_minus_monotonic_);
  out.T_odom_body = counters->T_odom_body;
  out.numbers = {};
  out.numbers[kX] = counters->x_units;
  out.numbers[kY] = counters->y_units;
  out.numbers[kHeading] = static_cast<std::uint16_t>(counters->heading_units);
  out.numbers[kStartBaud] = static_cast<std::uint64_t>(session->start_baud);
  out.numbers[kBaud] = static_cast<std::uint64_t>(session->baud);
  return true;
}

void PioneerDriver::restore(const OdometerMemory& memory) {
  const Clock::time_point at = instant_of(memory.at, epoch_minus_monotonic_);
  const auto& numbers = memory.numbers;
  const pioneer::SessionMemory session{.robot = named(memory.robot),
                                       .start_baud = static_cast<int>(numbers[kStartBaud]),
                                       .baud = static_cast<int>(numbers[kBaud]),
                                       .heard = at};
  const bool is_ours = is_of(memory.odometer, settings_.device) && session_.restore(session);
  if (!is_ours) return odometer_.follow(memory.origin);
  odometer_.restore({.x_units = static_cast<std::uint16_t>(numbers[kX]),
                     .y_units = static_cast<std::uint16_t>(numbers[kY]),
                     .heading_units = static_cast<std::int16_t>(static_cast<std::uint16_t>(numbers[kHeading])),
                     .at = at,
                     .T_odom_body = memory.T_odom_body,
                     .origin = memory.origin},
                    odometer_setup());
}

}  // namespace azimuth
