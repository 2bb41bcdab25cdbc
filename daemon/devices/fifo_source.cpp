#include "daemon/devices/fifo_source.hpp"

#include <fmt/format.h>

#include "daemon/pipeline/nap.hpp"

namespace azimuth {

FifoSource::FifoSource(const FifoSettings& settings, Duration epoch_minus_monotonic)
    : settings_(settings), odometer_(settings, epoch_minus_monotonic) {}

bool FifoSource::turn(Doorbell& bell, SourceWires& wires) {
  const Clock::time_point now = Clock::now();
  odometer_.turn(now);
  while (odometer_.take(reading_)) {
    silent_at_ = now + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(settings_.silent_s));
    wires.odometry.push(reading_);
  }
  report(wires,
         !odometer_.trouble().empty() ? Condition::unopened
         : now < silent_at_           ? Condition::running
                                      : Condition::silent,
         now);
  bell.wait_also(odometer_.descriptor(), POLLIN, kNap);
  return true;
}

void FifoSource::report(SourceWires& wires, Condition condition, Clock::time_point now) {
  const bool is_change = pace_.is_change(condition);
  if (!pace_.due(condition, now)) return;
  status_.works = condition == Condition::running;
  status_.text = fmt::format("{} ({})", status_.works ? "running" : "silent", settings_.path);
  if (condition == Condition::unopened) status_.text = odometer_.trouble();
  if (odometer_.refused() > 0)
    status_.text += fmt::format(", {} lines refused: {}", odometer_.refused(), odometer_.refusal());
  if (is_change) {
    DeviceEvent event{!status_.works, "odometer: " + status_.text};
    wires.events.push(event);
  }
  wires.status.publish(status_);
}

}  // namespace azimuth
