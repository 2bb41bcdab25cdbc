#pragma once
#include <chrono>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "tools/view/times.hpp"

namespace azimuth {

/// Measures message rates, the latency of poses and the NIS of the estimator between two status messages.
///
/// Thread contract: thread-bound.
class Measured {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Measured(Clock::time_point now) : since_(now) {}

  void pose(std::int64_t utime_us, const Reception& heard);
  void odometry() { ++odometry_; }
  void image() { ++images_; }
  void innovations(double nis, std::int32_t compared);

  /// Adds "rates", "latency_s" and "nis" to a status and resets the measurement.
  void put_into(nlohmann::json& status, Clock::time_point now);

 private:
  nlohmann::json rates(Clock::time_point now);

  Clock::time_point since_;
  std::uint64_t poses_ = 0, odometry_ = 0, images_ = 0;
  double latency_s_ = std::numeric_limits<double>::quiet_NaN();  // latency of the last pose
  double nis_ = 0.0;
  std::int64_t compared_ = 0;
};

}  // namespace azimuth
