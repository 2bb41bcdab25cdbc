#pragma once
#include <chrono>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "tools/view/heard.hpp"

namespace azimuth {

/// What no message says by itself: how often they come, how late poses are, and how honest the estimator is, from one
/// status to the next.
///
/// Thread contract: thread-bound.
class Measured {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Measured(Clock::time_point now) : since_(now) {}

  void pose(std::int64_t utime_us, const Heard& heard);
  void odometry() { ++odometry_; }
  void image() { ++images_; }
  void innovations(double nis, std::int32_t compared);

  /// Puts "rates", "latency_s" and "nis" into a status, and begins anew.
  void put_into(nlohmann::json& status, Clock::time_point now);

 private:
  nlohmann::json rates(Clock::time_point now);

  Clock::time_point since_;
  std::uint64_t poses_ = 0, odometry_ = 0, images_ = 0;
  double latency_s_ = std::numeric_limits<double>::quiet_NaN();  // of the last pose
  double nis_ = 0.0;
  std::int64_t compared_ = 0;
};

}  // namespace azimuth
