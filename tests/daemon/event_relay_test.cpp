#include <gtest/gtest.h>

#include "base/ring.hpp"
#include "daemon/devices/polled_source.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using Events = EveryOne<DeviceEvent, 16>;

/// The events of a driver.
struct TalkativeDriver {
  bool take_event(std::string& event) { return events.pop(event); }

  Ring<std::string, 64> events;
};

class EventRelayTest : public testing::Test {
 protected:
  std::vector<std::string> told() {
    std::vector<std::string> lines;
    while (events_.pop(event_)) lines.push_back((event_.trouble ? "! " : "") + event_.text);
    return lines;
  }

  Doorbell bell_;
  OdometryWire odometry_{bell_};
  Newest<DeviceStatus> status_{bell_};
  Events events_{bell_};
  SourceWires wires_{odometry_, nullptr, nullptr, status_, events_};
  TalkativeDriver driver_;
  EventRelay relay_;
  DeviceEvent event_;
};

TEST_F(EventRelayTest, PassesEverythingOnInItsOrder) {
  relay_.pass_on(driver_, true, "camera: ", wires_);
  EXPECT_TRUE(told().empty());
  driver_.events.push("gone");
  driver_.events.push("looked for");
  relay_.pass_on(driver_, true, "camera: ", wires_);
  driver_.events.push("back");
  relay_.pass_on(driver_, false, "", wires_);
  EXPECT_EQ(told(), (std::vector<std::string>{"! camera: gone", "! camera: looked for", "back"}));
}

TEST_F(EventRelayTest, AnEventIsNoPortResetBecauseAnEarlierOneWas) {
  for (std::size_t i = 0; i < 2 * Events::capacity(); ++i) {
    event_ = {.trouble = true, .text = "reset", .port_reset = true};
    events_.push(event_);
    told();
  }
  for (std::size_t i = 0; i < 2 * Events::capacity(); ++i) {
    driver_.events.push("back");
    relay_.pass_on(driver_, false, "", wires_);
    ASSERT_TRUE(events_.pop(event_));
    EXPECT_FALSE(event_.port_reset);
  }
}

TEST_F(EventRelayTest, WhatFindsNoRoomIsLostAndTheRestIsWhole) {
  for (int i = 0; i < 40; ++i) driver_.events.push(std::to_string(i));
  relay_.pass_on(driver_, true, "", wires_);
  const std::vector<std::string> lines = told();
  ASSERT_EQ(lines.size(), Events::capacity());
  EXPECT_EQ(lines.front(), "! 0");
  EXPECT_EQ(lines.back(), "! 15");
  driver_.events.push("later");
  relay_.pass_on(driver_, false, "", wires_);
  EXPECT_EQ(told(), std::vector<std::string>{"later"});
}

TEST_F(EventRelayTest, AllocatesNothingOnceStorageHasGrown) {
  const std::string line(100, 'x');
  const auto pass_one_on = [&] {
    relay_.pass_on(driver_, false, "camera: ", wires_);
    return events_.pop(event_) && event_.text.size() == 108;
  };
  for (int i = 0; i < 40; ++i) {
    driver_.events.push(line);
    ASSERT_TRUE(pass_one_on());
  }
  for (int i = 0; i < 40; ++i) {
    driver_.events.push(line);  // the driver's push allocates, as drivers may
    const std::size_t before = allocations();
    const bool passed = pass_one_on();
    EXPECT_EQ(allocations(), before);
    EXPECT_TRUE(passed);
  }
}

}  // namespace
}  // namespace azimuth
