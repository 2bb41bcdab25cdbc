#include "daemon/devices/can_source.hpp"

#include <azimuth/status_t.hpp>
#include <utility>

#include "daemon/devices/status_words.hpp"

namespace azimuth {
namespace {

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

}  // namespace azimuth
