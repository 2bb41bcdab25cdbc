#pragma once
// Session and odometer with a robot that sends anything, for the fuzzer and for random scripts. Aborts if an invariant
// is violated.

#include <cmath>
#include <cstdlib>
#include <optional>

#include "drivers/pioneer/odometer.hpp"
#include "drivers/pioneer/session.hpp"
#include "tests/drivers/pioneer/fake_controller.hpp"

namespace azimuth::pioneer::test {

inline void require(bool condition) {
  if (!condition) std::abort();
}

class Conversation {
 public:
  explicit Conversation(const PioneerSettings& settings) : session_(settings, true), odometer_(settings, Duration{0}) {}

  /// Plays a script: each byte is an instruction, some with operands.
  void play(ByteView script) {
    while (!script.empty()) {
      const std::uint8_t instruction = script.front();
      script = script.subspan(1);
      const auto some = script.first(std::min<std::size_t>(script.size(), instruction / 8));
      switch (instruction % 8) {
        case 0:  // noise
          hear(some);
          script = script.subspan(some.size());
          break;
        case 1:  // a valid packet with any content
          if (!some.empty()) hear(encode_frame(some).view());
          script = script.subspan(some.size());
          break;
        case 2:
          run(std::chrono::milliseconds(10 * (instruction / 8)));
          break;
        case 3:
          hear(controller_.cycle());
          break;
        case 4:
          controller_.restart();
          break;
        case 5:
          move(some);
          break;
        case 6:
          controller_.config_checksum_is_wrong = instruction / 8 % 2 != 0;
          controller_.config.auto_baud = instruction / 16;
          break;
        case 7:
          if (instruction > 250) session_.drop();
          if (instruction > 240) session_.close(now_);
          act();
          break;
      }
    }
  }

  std::uint64_t opened() const { return session_.opened(); }
  std::uint64_t readings() const { return last_ ? last_->sequence + 1 : 0; }

  /// Whether a session opens with a robot that works correctly.
  bool recovers() {
    controller_.restart();
    for (int i = 0; i < 3000 && session_.phase() != SessionPhase::running; ++i) run(std::chrono::milliseconds(10));
    return session_.phase() == SessionPhase::running;
  }

 private:
  void move(ByteView by) {
    if (by.size() < 3) return;
    controller_.sip.x_units = static_cast<std::uint16_t>(controller_.sip.x_units + by[0] * 8);
    controller_.sip.heading_units = static_cast<std::int16_t>(by[1] * 16 - 2048);
    controller_.ticks.left_ticks += by[2] * 1000;
    controller_.ticks.right_ticks += by[0] * 1000;
  }

  void run(Clock::duration time) {
    for (const auto end = now_ + time; now_ < end;) {
      now_ += std::chrono::milliseconds(10);
      if (session_.phase() == SessionPhase::idle || session_.phase() == SessionPhase::ended) session_.begin(now_);
      if (now_.time_since_epoch() % std::chrono::milliseconds(100) == Clock::duration{} &&
          line_baud_ == controller_.baud)
        hear(controller_.cycle());
      session_.turn(now_);
      require(session_.due_in(now_) >= Clock::duration{});
      act();
    }
  }

  void hear(ByteView bytes) {
    while (!bytes.empty()) {
      bytes = bytes.subspan(scanner_.add(bytes, now_));
      while (const auto packet = scanner_.next()) receive(*packet);
    }
  }

  void receive(const Packet& packet) {
    const Message message = decoded(packet);
    session_.receive(message, now_);
    if (session_.opened() != opened_) {
      opened_ = session_.opened();
      odometer_.begin_session({.parameters = session_.parameters(), .ticks_per_mm = 128.0, .use_gyro = true});
    }
    if (session_.is_open()) check(odometer_.add(message, std::chrono::microseconds(87)));
    act();
  }

  void check(const std::optional<OdometryReading>& reading) {
    if (!reading) return;
    const Pose2& T_odom_body = reading->T_odom_body;
    require(std::isfinite(T_odom_body.x_m) && std::isfinite(T_odom_body.y_m));
    require(T_odom_body.heading_rad >= -kPi && T_odom_body.heading_rad < kPi);
    require(std::isfinite(reading->sigma_gap_m) && reading->sigma_gap_m >= 0.0);
    require(std::isfinite(reading->sigma_gap_rad) && reading->sigma_gap_rad >= 0.0);
    if (last_) require(reading->stamp > last_->stamp && reading->sequence == last_->sequence + 1);
    last_ = reading;
  }

  void act() {
    if (is_acting_) return;  // the answers are processed after all actions
    is_acting_ = true;
    ByteVector answers;
    do {
      answers.clear();
      while (const auto action = session_.take()) {
        if (action->kind == SessionAction::Kind::set_baud) line_baud_ = action->baud;
        if (action->kind != SessionAction::Kind::send) continue;
        require(is_harmless(data_of(action->frame)));
        append(answers, controller_.receive(action->frame.view(), line_baud_));
      }
      hear(answers);
    } while (!answers.empty());
    is_acting_ = false;
  }

  FakeController controller_;
  Session session_;
  Odometer odometer_;
  PacketScanner scanner_{is_plausible_config};
  Clock::time_point now_{std::chrono::hours(1)};
  std::uint64_t opened_ = 0;
  int line_baud_ = 0;
  bool is_acting_ = false;
  std::optional<OdometryReading> last_;
};

}  // namespace azimuth::pioneer::test
