#include "daemon/pipeline/source_turn.hpp"

#include "daemon/pipeline/paces.hpp"

namespace azimuth {

void SourceTurn::operator()() {
  const bool goes_on = source_.turn(bell_, wires_.samples);
  if (wires_.memories) hand_over_memory();
  if (!goes_on) wires_.over.set();
}

void SourceTurn::hand_over_memory() {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_memory_ || !source_.remember(memory_)) return;
  next_memory_ = now + kHandOverInterval;
  wires_.memories->publish(memory_);
}

}  // namespace azimuth
