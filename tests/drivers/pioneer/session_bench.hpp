#pragma once
// A session and a controller, connected by a line in virtual time.

#include <algorithm>
#include <cstdint>
#include <gmock/gmock.h>
#include <optional>

#include "drivers/pioneer/session.hpp"
#include "tests/drivers/pioneer/fake_controller.hpp"

namespace azimuth::pioneer::test {

using namespace std::chrono_literals;

inline PioneerSettings fixed(int baud) {
  PioneerSettings settings;
  settings.baud = baud;
  return settings;
}

class SessionBench {
 public:
  explicit SessionBench(const PioneerSettings& settings = {}, bool has_baud = true)
      : session(settings, has_baud), has_baud_(has_baud) {}

  FakeController controller;
  Session session;
  Clock::time_point now{1h};
  bool connected = true;  // false: the line is cut in both directions
  int gave_up = 0, ended = 0;
  int line_baud = 0;

  void begin() {
    session.begin(now);
    act();
  }

  /// Runs in steps of 10 ms; a controller in a session sends every 100 ms.
  void run(Clock::duration time) {
    for (const auto end = now + time; now < end;) {
      now += 10ms;
      if (now.time_since_epoch() % 100ms == 0ms) hear(controller.cycle(), controller.baud);
      session.turn(now);
      act();
    }
  }

  /// Receives bytes from the robot.
  void hear(ByteView bytes, int at_baud) {
    if (!connected || (has_baud_ && at_baud != line_baud)) return;
    scanner_.add(bytes, now);
    while (const auto packet = scanner_.next()) {
      session.receive(decoded(*packet), now);
      act();
    }
  }

  void close() {
    session.close(now);
    act();
  }

  /// Number of times that the robot received a command.
  std::int64_t count(const Frame& frame) const { return std::ranges::count(controller.commands, data_of(frame)); }

 private:
  void act() {
    while (const auto action = session.take()) {
      switch (action->kind) {
        case SessionAction::Kind::send:
          send(action->frame);
          break;
        case SessionAction::Kind::set_baud:
          line_baud = action->baud;
          break;
        case SessionAction::Kind::flush_input:
          answers_.clear();
          break;
        case SessionAction::Kind::give_up:
          ++gave_up;
          break;
        case SessionAction::Kind::end:
          ++ended;
          break;
      }
    }
    const ByteVector answers = std::exchange(answers_, {});
    if (!answers.empty()) hear(answers, controller.baud);
  }

  void send(const Frame& frame) {
    EXPECT_TRUE(is_harmless(data_of(frame))) << "command " << int{frame.bytes[3]};
    if (connected) append(answers_, controller.receive(frame.view(), has_baud_ ? line_baud : 0));
  }

  bool has_baud_;
  PacketScanner scanner_{is_plausible_config};
  ByteVector answers_;
};

}  // namespace azimuth::pioneer::test
