#pragma once
// An odometer and the packets that it receives.

#include <chrono>
#include <cmath>
#include <cstdint>
#include <vector>

#include "drivers/pioneer/odometer.hpp"
#include "slam/geometry/angle.hpp"
#include "tests/drivers/pioneer/stream.hpp"

namespace azimuth::pioneer::test {

inline constexpr double kUnit_rad = 2.0 * kPi / 4096.0;
inline constexpr Clock::time_point kBenchStart{std::chrono::hours(1)};

/// A robot whose cycles the test delivers to the odometer or drops.
class OdometerBench {
 public:
  explicit OdometerBench(const OdometerSetup& setup = {}, const PioneerSettings& settings = {})
      : odometer(settings, Duration{0}) {
    odometer.begin_session(setup);
  }

  Odometer odometer;
  Clock::time_point now = kBenchStart;
  StandardSip sip;
  std::vector<OdometryReading> readings;

  void hear(const Frame& frame, Clock::time_point at) {
    const ByteVector data = data_of(frame);
    if (const auto reading = odometer.add(decoded({data, at, true}), {})) readings.push_back(*reading);
  }
  void hear(const Frame& frame) { hear(frame, now); }
  void hear_sip() { hear(encode_sip(sip)); }
  const OdometryReading& last() const { return readings.back(); }
};

/// The value of a counter with the given width.
inline std::uint16_t counter(double units, unsigned mask) {
  return static_cast<std::uint16_t>(static_cast<unsigned>(std::lround(units)) & mask);
}

}  // namespace azimuth::pioneer::test
