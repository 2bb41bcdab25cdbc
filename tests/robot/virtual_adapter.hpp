#pragma once
// A USB serial adapter in virtual time, between the simulated line and the driver.

#include <cstdint>
#include <deque>
#include <vector>

#include "drivers/pioneer/device_link.hpp"
#include "sim/pioneer/simulated_pioneer.hpp"
#include "sim/world/random.hpp"

namespace azimuth::test {

/// Delays of a byte from its end on the wire to the driver.
struct AdapterSettings {
  Duration latency{1000};
  /// If not 0, the adapter collects bytes and delivers them at the ticks of this timer.
  Duration timer{};
  /// Additional random delay of the host's scheduling, uniformly distributed from 0 to `jitter`.
  Duration jitter{};
};

/// Owned by the test; the links refer to it. Thread contract: thread-bound.
class VirtualAdapter {
 public:
  /// `pioneer` must outlive this object.
  VirtualAdapter(sim::SimulatedPioneer& pioneer, const AdapterSettings& settings, std::uint64_t seed);

  pioneer::LinkOpener opener();

  /// Takes bytes from the line that are complete by `now`. Bytes are lost while nobody has the device open.
  void advance(Stamp now);
  /// Passes the driver's output to the line.
  void send_written();
  /// The next instant at which a driver waiting for the device wakes up; Stamp::max() means never.
  Stamp due() const;

 private:
  class End;  // the driver's end of the link
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
  bool torn_off_ = false;  // somebody unplugged the cable while the device was open
};

}  // namespace azimuth::test
