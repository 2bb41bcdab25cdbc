#include "daemon/devices/can_source.hpp"

#include <algorithm>
#include <azimuth/status_t.hpp>
#include <fmt/format.h>
#include <utility>

#include "daemon/pipeline/nap.hpp"

namespace azimuth {
namespace {

std::uint32_t flags(const CanState& state) {
  const auto flag = [](bool set, std::int32_t bit) { return set ? static_cast<std::uint32_t>(bit) : 0U; };
  return flag(state.emergency_stop, status_t::ROBOT_EMERGENCY_STOP) | flag(state.bumper, status_t::ROBOT_BUMPER) |
         flag(state.charging, status_t::ROBOT_CHARGING);
}

/// Losses and errors are told when there are any.
std::string description(const CanState& state) {
  std::string words = text(state.connection);
  if (state.connection != Connection::running && !state.trouble.empty()) words += ": " + state.trouble;
  if (state.bus != CanBusState::active && state.bus != CanBusState::off) words += fmt::format(", {}", text(state.bus));
  for (const auto& [count, what] :
       {std::pair(state.missed, "values missed"), std::pair(state.dropped, "frames dropped"),
        std::pair(state.malformed, "malformed"), std::pair(state.bus_offs, "bus-offs"),
        std::pair(state.restarts, "restarts of the base")})
    if (count > 0) words += fmt::format(", {} {}", count, what);
  return words;
}

}  // namespace

CanSource::CanSource(const CanSettings& settings, const CanLayout& layout, Duration epoch_minus_monotonic,
                     CanLinkOpener open_link)
    : driver_(settings, layout, epoch_minus_monotonic, std::move(open_link)) {}

bool CanSource::turn(Doorbell& bell, SourceWires& wires) {
  driver_.turn(CanDriver::Clock::now());
  while (driver_.take(reading_)) wires.odometry.push(reading_);
  report(wires);
  const auto idle = std::min<CanDriver::Clock::duration>(kNap, driver_.due_in(CanDriver::Clock::now()));
  bell.wait_also(driver_.descriptor(), driver_.poll_events(), idle);
  return true;
}

void CanSource::report(SourceWires& wires) {
  const CanState& state = driver_.state();
  const bool works = state.connection == Connection::running;
  relay_.pass_on(driver_, !works, "", wires);
  if (!pace_.due(state.connection, CanDriver::Clock::now())) return;
  status_.works = works;
  status_.text = description(state);
  status_.reconnects = state.reconnects();
  status_.battery_v = state.battery_V;
  status_.robot_flags = flags(state);
  wires.status.publish(status_);
}

}  // namespace azimuth
