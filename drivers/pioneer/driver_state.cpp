// The driver's reports about the robot and the line to it, and the state that outlives the driver, so that the next
// driver continues the same session.

#include <algorithm>
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

using pioneer::SessionPhase;

pioneer::OdometerSetup PioneerDriver::odometer_setup() const {
  pioneer::OdometerSetup setup{.parameters = session_.parameters(), .use_gyro = session_.uses_gyro()};
  const auto& config = session_.config();
  if (config) setup.sip_cycle_s = 1e-3 * std::max<int>(5, config->sip_cycle_ms);
  setup.ticks_per_mm = settings_.ticks_per_mm > 0.0 ? settings_.ticks_per_mm : config ? config->ticks_per_mm : 0.0;
  if (settings_.encoder == PioneerFeature::off) setup.ticks_per_mm = 0.0;
  return setup;
}

/// Passes changes of the session on to the odometer, the state and the log.
void PioneerDriver::follow_session() {
  if (session_.reboots() != state_.reboots) {
    state_.reboots = session_.reboots();
    enter(Connection::starting, settings_.device + ": the controller restarted");
  }
  if (session_.opened() != state_.sessions) {
    state_.sessions = session_.opened();
    followed_ = Followed::opening;
    state_.name = session_.robot().name;
    state_.subclass = session_.robot().subclass;
    odometer_.begin_session(odometer_setup());
    news_.tell("session with \"" + state_.name + "\" (" + state_.subclass + ") on " + settings_.device);
  }
  if (session_.resumed() != state_.resumed) {
    state_.resumed = session_.resumed();
    state_.name = session_.robot().name;
    state_.subclass = session_.robot().subclass;
    news_.tell("the session with \"" + state_.name + "\" goes on");
  }
  const auto reached = session_.config() ? Followed::config : Followed::no_config;
  if (session_.phase() != SessionPhase::running || followed_ == reached) return;
  followed_ = reached;
  follow_config();
}

void PioneerDriver::follow_config() {
  odometer_.refine(odometer_setup());
  state_.uses_gyro = session_.uses_gyro();
  state_.config_unverified = session_.config_unverified();
  if (!session_.config()) return news_.tell(state_.name + " does not tell its parameters: defaults are used");
  state_.firmware = session_.config()->firmware_version;
  if (state_.config_unverified)
    news_.tell(state_.name + " sends its parameters with a wrong checksum; they are plausible and used");
  if (session_.baud_refused()) news_.tell(state_.name + " does not follow to a higher baud rate");
}

void PioneerDriver::look_at(const pioneer::StandardSip& sip, Clock::time_point now) {
  last_sip_ = now;
  served_ = true;
  standing_.reset();  // the robot answers on this link
  back_off_.succeeded();
  refusal_back_off_ = kFirstAfterRefusal;
  enter(Connection::running, {});
  state_.battery_V = sip.battery_volts();
  state_.charge = {.percent = sip.charge_percent ? int{*sip.charge_percent} : -1,
                   .state = sip.charge_state.value_or(255)};
  state_.left_stall = sip.left_stall();
  state_.right_stall = sip.right_stall();
  state_.bumpers = {.front = sip.front_bumpers(), .rear = sip.rear_bumpers()};
  state_.motors_enabled = sip.motors_enabled();
  state_.emergency_stop = sip.emergency_stop();
}

void PioneerDriver::watch_staleness(Clock::time_point now) {
  if (state_.connection != Connection::running || now - last_sip_ < clock_duration(settings_.stale_s)) return;
  ++state_.stale;
  enter(Connection::silent, settings_.device + ": no odometry");
}

/// Skipped bytes count only while odometry arrives. During the search and a change of the baud rate they are normal.
void PioneerDriver::update_counters(bool ran) {
  state_.baud = session_.baud();
  state_.uses_ticks = odometer_.uses_ticks();
  state_.speed_m_s = odometer_.speed_m_s();
  state_.bad_checksums = scanner_.bad_checksums();
  const std::uint64_t skipped = scanner_.skipped_bytes() - std::exchange(skipped_before_, scanner_.skipped_bytes());
  if (ran) state_.skipped_bytes += skipped;
  state_.gaps = odometer_.gaps();
}

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
