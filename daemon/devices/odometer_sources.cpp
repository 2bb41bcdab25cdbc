#include "daemon/devices/odometer_sources.hpp"

#include <azimuth/status_t.hpp>
#include <fmt/format.h>
#include <limits>
#include <utility>

#include "daemon/devices/status_words.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
constexpr auto kTimeToClose = 400ms;
/// How long the driver leaves the adapter alone during a reset, if the end of the reset is not reported.
constexpr auto kTimeToReset = 20s;

std::uint32_t flags(const PioneerState& state) {
  const bool charging = state.charge.state >= 1 && state.charge.state <= 4;
  return robot_flag(state.motors_enabled, status_t::ROBOT_MOTORS_ENABLED) |
         robot_flag(state.emergency_stop, status_t::ROBOT_EMERGENCY_STOP) |
         robot_flag(state.left_stall, status_t::ROBOT_STALL_LEFT) |
         robot_flag(state.right_stall, status_t::ROBOT_STALL_RIGHT) |
         robot_flag(state.bumpers.front != 0 || state.bumpers.rear != 0, status_t::ROBOT_BUMPER) |
         robot_flag(charging, status_t::ROBOT_CHARGING);
}

std::uint32_t flags(const CanState& state) {
  return robot_flag(state.emergency_stop, status_t::ROBOT_EMERGENCY_STOP) |
         robot_flag(state.bumper, status_t::ROBOT_BUMPER) | robot_flag(state.charging, status_t::ROBOT_CHARGING);
}

}  // namespace

CanSource::CanSource(const CanSettings& settings, const CanLayout& layout, Duration epoch_minus_monotonic,
                     CanLinkOpener open_link)
    : driver_(settings, layout, epoch_minus_monotonic, std::move(open_link)) {}

void CanSource::work(Clock::time_point now, SourceWires& wires) {
  driver_.turn(now);
  while (driver_.take(reading_)) wires.odometry.push(reading_);
}

/// Losses and bus errors are mentioned only if there are any.
void CanSource::describe(DeviceStatus& status) const {
  const CanState& state = driver_.state();
  put_state(state, status.text);
  if (state.bus != CanBusState::active && state.bus != CanBusState::off)
    status.text.append(", ").append(text(state.bus));
  append_losses({{state.missed, "values missed"},
                 {state.dropped, "frames dropped"},
                 {state.malformed, "malformed"},
                 {state.bus_offs, "bus-offs"},
                 {state.restarts, "restarts of the base"}},
                status.text);
  status.reconnects = state.reconnects();
  status.battery_v = state.battery_V;
  status.robot_flags = flags(state);
}

FifoSource::FifoSource(const FifoSettings& settings, Duration epoch_minus_monotonic)
    : path_(settings.path), odometer_(settings, epoch_minus_monotonic) {}

void FifoSource::work(Clock::time_point now, SourceWires& wires) {
  odometer_.turn(now);
  while (odometer_.take(reading_)) wires.odometry.push(reading_);
}

void FifoSource::describe(DeviceStatus& status) const {
  const FifoState& state = odometer_.state();
  put_state(state, status.text);
  if (state.connection == Connection::running) fmt::format_to(std::back_inserter(status.text), " ({})", path_);
  if (state.refused > 0)
    fmt::format_to(std::back_inserter(status.text), ", {} lines refused: {}", state.refused, state.refusal);
}

PioneerSource::PioneerSource(const PioneerSettings& settings, Duration epoch_minus_monotonic, AdapterHelp help)
    : device_(settings.device), driver_(settings, epoch_minus_monotonic), help_(std::move(help)) {}

void PioneerSource::work(Clock::time_point now, SourceWires& wires) {
  if (help_.usb.turn()) driver_.wake(now);
  driver_.turn(now);
  while (driver_.take(reading_)) wires.odometry.push(reading_);
  help(now);
}

PolledSource::Polled PioneerSource::polled() const {
  return {pollfd{.fd = driver_.descriptor(), .events = driver_.poll_events(), .revents = 0}, help_.usb.polled()};
}

void PioneerSource::help(Clock::time_point now) {
  if (const int before = std::exchange(descriptor_, driver_.descriptor()); descriptor_ >= 0 && descriptor_ != before)
    find_port();
  if (driver_.state().connection == Connection::running) help_.usb.works();
  if (help_.usb.take_end()) driver_.wake(now);
  if (driver_.silent_for(now) < help_.reset_after || !help_.usb.may_reset(now)) return;
  if (port_.empty()) find_port();  // the device could not be opened yet
  if (help_.usb.reset(port_, now)) driver_.release(now, kTimeToReset);
}

/// To be called while the adapter is plugged in, because sysfs does not list an unplugged adapter.
void PioneerSource::find_port() {
  const std::optional<UsbPort> port = help_.find_port(device_);
  port_ = port ? port->text() : std::string();
}

void PioneerSource::tell(EventRelay& relay, bool trouble, SourceWires& wires) {
  relay.pass_on(driver_, trouble, "", wires);
  relay.pass_on(help_.usb, "odometer: ", wires);
}

void PioneerSource::describe(DeviceStatus& status) const {
  const PioneerState& state = driver_.state();
  put_state(state, status.text);
  if (!state.subclass.empty())
    fmt::format_to(std::back_inserter(status.text), " ({} {}{})", state.subclass, state.name,
                   state.config_unverified ? ", configuration unverified" : "");
  status.reconnects = state.reconnects();
  status.port_resets = help_.usb.resets();
  status.battery_v = state.battery_V > 0.0 ? state.battery_V : std::numeric_limits<double>::quiet_NaN();
  status.robot_flags = flags(state);
}

void PioneerSource::close() { driver_.close(Clock::now() + kTimeToClose); }

}  // namespace azimuth
