#pragma once
#include <azimuth/pose_cov_t.hpp>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "drivers/wire/channels.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth::bench {

/// Measures the time from handing over a sample to sending its pose. Thread contract: thread-safe.
class Latencies {
 public:
  void handed_over(Stamp stamp) {
    const std::scoped_lock lock(mutex_);
    waiting_.push_back({stamp, std::chrono::steady_clock::now()});
  }
  void sent(Stamp stamp) {
    const auto now = std::chrono::steady_clock::now();
    const std::scoped_lock lock(mutex_);
    for (const auto& [of, since] : waiting_)
      if (of == stamp) latencies_us_.push_back(std::chrono::duration<double, std::micro>(now - since).count());
    std::erase_if(waiting_, [&](const Waiting& sample) { return sample.stamp <= stamp; });  // poses are in order
  }
  /// Callback for Publisher::listen(): reacts to the poses of steps.
  void published(std::string_view channel, std::span<const std::byte> message, Stamp utime) {
    pose_cov_t pose{};
    if (channel != channel::kPose) return;
    if (pose.decode(message.data(), 0, static_cast<int>(message.size())) > 0 && pose.predicted == 0) sent(utime);
  }
  std::vector<double> take() {
    const std::scoped_lock lock(mutex_);
    return std::move(latencies_us_);
  }

 private:
  struct Waiting {
    Stamp stamp;
    std::chrono::steady_clock::time_point since;
  };
  std::mutex mutex_;
  std::vector<Waiting> waiting_;
  std::vector<double> latencies_us_;
};

}  // namespace azimuth::bench
