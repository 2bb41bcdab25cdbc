#pragma once
// A USB serial adapter in virtual time: what lies between the simulated line and the driver.

#include <cstdint>
#include <deque>
#include <vector>

#include "drivers/pioneer/link.hpp"
#include "sim/pioneer/simulated_pioneer.hpp"
#include "sim/world/random.hpp"

namespace azimuth::test {

/// How long a byte that is whole on the wire takes to the driver.
struct AdapterSettings {
  Duration latency{1000};
  /// Not zero: the adapter collects bytes and passes them on at the ticks of this timer ...
  Duration timer{};
  /// ... and up to so much later, evenly spread: the host's own scheduling.
  Duration jitter{};
};

/// Owned by the test; links lead to it. Thread contract: thread-bound.
class VirtualAdapter {
 public:
  /// `pioneer` outlives this.
  VirtualAdapter(sim::SimulatedPioneer& pioneer, const AdapterSettings& settings, std::uint64_t seed);

  pioneer::LinkOpener opener();

  /// Takes from the line what became whole by `now`. Bytes that nobody has opened the device for are gone.
  void advance(Stamp now);
  /// Hands what the driver wrote to the line.
  void send_written();
  /// When a driver that sleeps on the device wakes up next; never is Stamp::max().
  Stamp due() const;

 private:
  class End;  // the driver's
  struct Arriving {
    Stamp at{};
    std::uint8_t byte = 0;
  };
  Stamp arrival(Stamp now);
  bool works(const End& end) const { return open_ == &end && pioneer_.plugged_in() && !torn_off_; }
  void forget();

  sim::SimulatedPioneer& pioneer_;
  AdapterSettings settings_;
  Random random_;
  Stamp now_{};
  std::deque<Arriving> arriving_;
  sim::Bytes whole_, written_;
  const End* open_ = nullptr;
  bool torn_off_ = false;  // the cable was out while the device was open
};

}  // namespace azimuth::test
