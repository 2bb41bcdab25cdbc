// Odometry from a FIFO, from the source to the pipeline's wires.

#include <fcntl.h>
#include <gtest/gtest.h>

#include "daemon/devices/odometer_sources.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

using Clock = FifoOdometer::Clock;

class FifoSourceTest : public testing::Test {
 protected:
  void turn() {
    bell_.ring();  // the turn must not sleep
    EXPECT_TRUE(source_.turn(bell_, wires_));
    status_wire_.take(status_);
    for (DeviceEvent event; events_wire_.pop(event);) events_.push_back(event.text);
  }
  void write_line() const {
    const UniqueFd writer(::open(settings_.path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
    const double now_s = std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
    const std::string line = std::to_string(now_s) + ",1.5,0,0\n";
    ASSERT_EQ(::write(writer.get(), line.data(), line.size()), static_cast<ssize_t>(line.size()));
  }

  test::TemporaryFolder folder_;
  FifoSettings settings_{.path = folder_ / "odometry", .silent_s = 0.05};
  Doorbell bell_, reader_;
  OdometryWire odometry_{reader_};
  Newest<DeviceStatus> status_wire_{reader_};
  EveryOne<DeviceEvent, 16> events_wire_{reader_};
  SourceWires wires_{odometry_, nullptr, nullptr, status_wire_, events_wire_};
  DeviceStatus status_;
  std::vector<std::string> events_;
  FifoSource source_{settings_, Duration{0}};
};

TEST_F(FifoSourceTest, ReadingsGoOnAndConditionsAreTold) {
  turn();
  EXPECT_FALSE(status_.works);
  EXPECT_EQ(status_.text, "starting");
  write_line();
  turn();
  OdometryReading reading;
  ASSERT_TRUE(odometry_.pop(reading));
  EXPECT_EQ(reading.T_odom_body.x_m, 1.5);
  EXPECT_TRUE(status_.works);
  EXPECT_EQ(status_.text, "running (" + settings_.path + ")");
  for (const auto limit = Clock::now() + std::chrono::seconds(20); status_.works && Clock::now() < limit;) turn();
  EXPECT_EQ(status_.text, "silent: " + settings_.path + ": no odometry");
  EXPECT_EQ(events_,
            (std::vector<std::string>{"odometry comes from " + settings_.path, settings_.path + ": no odometry"}))
      << "once a change";
}

TEST_F(FifoSourceTest, WhatCannotBeOpenedIsSaid) {
  const std::string path = folder_ / "none/odometry";
  FifoSource nowhere({.path = path}, Duration{0});
  bell_.ring();
  nowhere.turn(bell_, wires_);
  ASSERT_TRUE(status_wire_.take(status_));
  EXPECT_EQ(status_.text, "away: " + path + ": No such file or directory");
  EXPECT_FALSE(status_.works);
  DeviceEvent event;
  ASSERT_TRUE(events_wire_.pop(event));
  EXPECT_TRUE(event.trouble);
  EXPECT_EQ(event.text, path + ": No such file or directory");
}

}  // namespace
}  // namespace azimuth
