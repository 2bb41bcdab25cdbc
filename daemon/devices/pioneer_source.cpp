#include "daemon/devices/pioneer_source.hpp"

#include <algorithm>
#include <array>
#include <azimuth/status_t.hpp>
#include <fmt/format.h>
#include <limits>
#include <utility>

#include "daemon/pipeline/nap.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
constexpr auto kTimeToClose = 400ms;
/// How long an adapter is let alone for its reset, if nobody says that it has ended.
constexpr auto kTimeToReset = 20s;

std::uint32_t flags(const PioneerState& state) {
  const auto flag = [](bool set, std::int32_t bit) { return set ? static_cast<std::uint32_t>(bit) : 0U; };
  const bool charging = state.charge_state >= 1 && state.charge_state <= 4;
  return flag(state.motors_enabled, status_t::ROBOT_MOTORS_ENABLED) |
         flag(state.emergency_stop, status_t::ROBOT_EMERGENCY_STOP) |
         flag(state.left_stall, status_t::ROBOT_STALL_LEFT) | flag(state.right_stall, status_t::ROBOT_STALL_RIGHT) |
         flag(state.front_bumpers != 0 || state.rear_bumpers != 0, status_t::ROBOT_BUMPER) |
         flag(charging, status_t::ROBOT_CHARGING);
}

std::string description(const PioneerState& state) {
  std::string words = text(state.connection);
  if (state.connection != Connection::running && !state.trouble.empty()) words += ": " + state.trouble;
  if (state.subclass.empty()) return words;
  return fmt::format("{} ({} {}{})", words, state.subclass, state.name,
                     state.config_unverified ? ", configuration unverified" : "");
}

}  // namespace

PioneerSource::PioneerSource(const PioneerSettings& settings, Duration epoch_minus_monotonic, AdapterHelp help)
    : device_(settings.device), driver_(settings, epoch_minus_monotonic), help_(std::move(help)) {}

bool PioneerSource::turn(Doorbell& bell, SourceWires& wires) {
  const auto now = PioneerDriver::Clock::now();
  if (help_.usb.turn()) driver_.wake(now);
  driver_.turn(now);
  while (driver_.take(reading_)) wires.odometry.push(reading_);
  help(now);
  report(wires);
  const auto idle = std::min<PioneerDriver::Clock::duration>(kNap, driver_.due_in(PioneerDriver::Clock::now()));
  const pollfd line{.fd = driver_.descriptor(), .events = driver_.poll_events(), .revents = 0};
  bell.wait_also(std::array{line, help_.usb.polled()}, idle);
  return true;
}

void PioneerSource::help(PioneerDriver::Clock::time_point now) {
  if (const int before = std::exchange(descriptor_, driver_.descriptor()); descriptor_ >= 0 && descriptor_ != before)
    find_port();
  if (driver_.state().connection == Connection::running) help_.usb.works();
  if (help_.usb.take_end()) driver_.wake(now);
  if (driver_.silent_for(now) < help_.reset_after || !help_.usb.may_reset(now)) return;
  if (port_.empty()) find_port();  // it could not even be opened
  if (help_.usb.reset(port_, now)) driver_.release(now, kTimeToReset);
}

/// Asked while it is plugged in: afterwards sysfs does not know any more.
void PioneerSource::find_port() {
  const std::optional<UsbPort> port = help_.find_port(device_);
  port_ = port ? port->text() : std::string();
}

void PioneerSource::report(SourceWires& wires) {
  const PioneerState& state = driver_.state();
  const bool works = state.connection == Connection::running;
  relay_.pass_on(driver_, !works, "", wires);
  relay_.pass_on(help_.usb, "odometer: ", wires);
  if (!pace_.due(state.connection, PioneerDriver::Clock::now())) return;
  status_.works = works;
  status_.text = description(state);
  status_.reconnects = state.reconnects();
  status_.port_resets = help_.usb.resets();
  status_.battery_v = state.battery_V > 0.0 ? state.battery_V : std::numeric_limits<double>::quiet_NaN();
  status_.robot_flags = flags(state);
  wires.status.publish(status_);
}

void PioneerSource::close() { driver_.close(PioneerDriver::Clock::now() + kTimeToClose); }

}  // namespace azimuth
