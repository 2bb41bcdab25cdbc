#pragma once
// The driver with a device, in virtual time.

#include <chrono>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "drivers/pioneer/driver.hpp"
#include "tests/drivers/pioneer/fake_controller.hpp"

namespace azimuth::pioneer::test {

using namespace std::chrono_literals;

inline constexpr Duration kEpochMinusMonotonic = 1'000'000s;

/// A driver with its readings and events.
class DriverBench {
 public:
  explicit DriverBench(const std::string& device, bool keep_session = false)
      : driver(settings(device, keep_session), kEpochMinusMonotonic) {}

  PioneerDriver driver;
  PioneerDriver::Clock::time_point now{1h};
  std::vector<OdometryReading> readings;
  std::vector<std::string> events;

  /// Calls the driver every 10 ms. The robot answers before each call and sends a cycle every 100 ms.
  template <class Robot>
  void run(PioneerDriver::Clock::duration time, Robot& robot, FakeController& controller) {
    for (const auto end = now + time; now < end;) {
      now += 10ms;
      robot.serve();
      if (now.time_since_epoch() % 100ms == 0ms) robot.send(controller.cycle());
      turn();
    }
  }
  /// Runs without a robot.
  void run(PioneerDriver::Clock::duration time) {
    for (const auto end = now + time; now < end; now += 10ms) turn();
  }

 private:
  static PioneerSettings settings(const std::string& device, bool keep_session) {
    PioneerSettings settings;
    settings.device = device;
    settings.keep_session = keep_session;
    return settings;
  }
  void turn() {
    EXPECT_GE(driver.due_in(now), 0ms);
    driver.turn(now);
    OdometryReading reading;
    while (driver.take(reading)) readings.push_back(reading);
    std::string event;
    while (driver.take_event(event)) events.push_back(event);
  }
};

/// The events, one per line.
inline std::string readable(const std::vector<std::string>& events) {
  std::string all;
  for (const auto& event : events) all += event + "\n";
  return all;
}

}  // namespace azimuth::pioneer::test
