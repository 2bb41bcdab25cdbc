#pragma once
// Writes field logs like a daemon, event by event.

#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/storage/event_log.hpp"
#include "drivers/storage/session.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/messages.hpp"

namespace azimuth::test {

inline constexpr std::int64_t kStart_us = 1'795'608'000'000'000;  // 2026-11-25T12:00:00Z

class RecordedLog {
 public:
  explicit RecordedLog(const std::filesystem::path& file, std::string prefix = "")
      : log_(*EventLogWriter::create(file)), prefix_(std::move(prefix)) {}

  RecordedLog& document(const char* name, const std::string& text) {
    return write(kStart_us, channel::kDocument, to_message(name, text, {}));
  }
  RecordedLog& mark(std::uint64_t number, std::uint64_t lost_events = 0) {
    return document(kSegmentDocument, to_text(SegmentMark{number, lost_events}));
  }
  RecordedLog& documents() {
    document("rig.toml", "[camera]\nmodel = \"bearings\"\nsigma_bearing_rad = 0.01\n");
    document(kConfigurationDocument, "estimator = \"fastslam\"\n");
    return document(kVersionDocument, "azimuthd 1.2.3\n");
  }
  RecordedLog& pose(double t_s, double x_m, std::int8_t health, bool predicted = false) {
    pose_cov_t message{};
    message.utime = kStart_us + static_cast<std::int64_t>(t_s * 1e6);
    message.x_m = x_m;
    message.y_m = -0.5 * x_m;
    message.odom_x_m = x_m;
    message.health = health;
    message.predicted = predicted ? 1 : 0;
    return write(message.utime, channel::kPose, message);
  }
  RecordedLog& odometer(const std::string& words) {
    status_t status{};
    status.odometer = words;
    return write(kStart_us, channel::kStatus, status);
  }
  RecordedLog& raw(std::string_view channel, Bytes data) {
    EXPECT_FALSE(log_.write(kStart_us, prefix_ + std::string(channel), data));
    return *this;
  }

 private:
  template <class Message>
  RecordedLog& write(std::int64_t utime_us, std::string_view channel, const Message& message) {
    encode(message, data_);
    EXPECT_FALSE(log_.write(utime_us, prefix_ + std::string(channel), data_));
    return *this;
  }

  EventLogWriter log_;
  std::string prefix_;
  std::vector<std::byte> data_;
};

}  // namespace azimuth::test
