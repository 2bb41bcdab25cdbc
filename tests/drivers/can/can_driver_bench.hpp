#pragma once
// The driver on a scripted bus, in virtual time.

#include <cerrno>
#include <chrono>
#include <deque>
#include <gtest/gtest.h>

#include "drivers/can/can_driver.hpp"
#include "tests/drivers/can/fake_base.hpp"

namespace azimuth::test {

using namespace std::chrono_literals;

/// State of the interface, and the frames that wait in its socket.
struct FakeBus {
  bool is_there = true, is_up = true;
  int generation = 0;  // changes with each replug
  int opened = 0;
  std::deque<CanReception> waiting;
  CanLink::Counts counts;
  std::vector<CanId> asked_for;
};

class FakeCanLink final : public CanLink {
 public:
  explicit FakeCanLink(FakeBus& bus) : bus_(bus), generation_(bus.generation) {}
  int descriptor() const override { return 99; }
  Received receive(std::span<CanReception> into) override {
    if (!is_present()) return {0, false, CanTrouble{"can0", "read", ENODEV}};
    if (!bus_.is_up && !std::exchange(told_down_, true)) return {0, true, {}};
    if (bus_.is_up) told_down_ = false;
    Received received;
    for (; received.count < into.size() && !bus_.waiting.empty(); bus_.waiting.pop_front())
      into[received.count++] = bus_.waiting.front();
    return received;
  }
  bool is_present() const override { return bus_.is_there && bus_.generation == generation_; }
  Counts counts() const override { return bus_.counts; }
  std::string note() const override { return "little buffer"; }

 private:
  FakeBus& bus_;
  int generation_;
  bool told_down_ = false;
};

inline CanLayout robot_layout() {
  CanLayout layout = test::ticks_layout();
  layout.battery = CanSignal{test::kRobotId, {0, 16}, CanNumber::unsigned_integer, 0.01};
  layout.emergency_stop = CanSignal{test::kRobotId, {16, 3}};
  layout.bumper = CanSignal{test::kRobotId, {28, 4}};
  layout.charging = CanSignal{test::kRobotId, {32, 1}};
  return layout;
}

class DriverBench {
 public:
  FakeBus bus;
  CanLayout layout = robot_layout();
  CanDriver driver{CanSettings{}, layout, 1'000'000s,
                   [this](const std::string& name, std::span<const CanId> ids) { return open(name, ids); }};
  FakeBase base;
  DeviceClock::time_point now{1h};
  std::vector<OdometryReading> readings;
  std::vector<std::string> events;

  void run(DeviceClock::duration time, bool base_sends = true) {
    for (const auto end = now + time; now < end;) {
      now += 10ms;
      base.drive(0.5, 0.5, 0.01);
      if (base_sends && bus.is_there && bus.is_up)
        for (const CanFrame& frame : base.frames(layout)) bus.waiting.push_back({frame, now});
      turn();
    }
  }
  void turn() {
    EXPECT_GE(driver.due_in(now), 0ms);
    driver.turn(now);
    OdometryReading reading;
    while (driver.take(reading)) readings.push_back(reading);
    std::string event;
    while (driver.take_event(event)) events.push_back(event);
  }
  void error(std::uint32_t classes, std::uint8_t controller = 0) {
    CanFrame frame = test::empty_frame({classes, false});
    frame.kind = CanFrame::Kind::error;
    frame.data[1] = controller;
    bus.waiting.push_back({frame, now});
  }

 private:
  OpenedCanLink open(const std::string& name, std::span<const CanId> ids) {
    if (!bus.is_there) return tl::unexpected(CanTrouble{name, "no such interface", 0});
    ++bus.opened;
    bus.asked_for.assign(ids.begin(), ids.end());
    return std::make_unique<FakeCanLink>(bus);
  }
};

}  // namespace azimuth::test
