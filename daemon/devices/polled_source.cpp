#include "daemon/devices/polled_source.hpp"

#include <algorithm>

#include "daemon/pipeline/paces.hpp"

namespace azimuth {

bool PolledSource::turn(Doorbell& bell, SourceWires& wires) {
  work(Clock::now(), wires);
  report(wires);
  bell.wait_also(polled(), std::min<std::chrono::nanoseconds>(kNap, due_in(Clock::now())));
  return true;
}

void PolledSource::report(SourceWires& wires) {
  const std::optional<DeviceCondition> seen = condition();
  const bool works = seen && seen->connection == Connection::running;
  tell(relay_, !works, wires);
  if (!seen) return;
  const bool is_change = pace_.is_change(*seen);
  if (!pace_.due(*seen, Clock::now())) return;
  status_.works = works;
  describe(status_);
  if (is_change && status_is_news()) tell_change(wires);
  wires.status.publish(status_);
}

void PolledSource::tell_change(SourceWires& wires) {
  change_.trouble = !status_.works;
  change_.port_reset = false;
  change_.text.assign(name()).append(": ").append(status_.text);
  wires.events.push(change_);
}

}  // namespace azimuth
