#include "daemon/devices/fifo_source.hpp"

#include "daemon/devices/status_words.hpp"

namespace azimuth {

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

}  // namespace azimuth
