// The actions of a session, and the times of its next turn.

#include <algorithm>
#include <cassert>
#include <utility>

#include "drivers/device/device_clock.hpp"
#include "drivers/pioneer/session.hpp"

namespace azimuth::pioneer {

namespace {
using Kind = SessionAction::Kind;
}  // namespace

void Session::send(Command command) { send(encode_command(command)); }
void Session::send(Command command, int argument) { send(encode_command(command, argument)); }

void Session::send(const Frame& frame) {
  act(Kind::send);
  actions_.newest().frame = frame;
  last_sent_ = now_;
}

void Session::act(Kind kind) { actions_.add().kind = kind; }

SessionAction& Session::Actions::add() {
  assert(count_ < ring_.size());
  ++count_;
  return newest();
}

std::optional<SessionAction> Session::Actions::take() {
  if (count_ == 0) return std::nullopt;
  const SessionAction& action = ring_[first_];
  first_ = (first_ + 1) % ring_.size();
  --count_;
  return action;
}

void Session::set_baud(int baud) {
  rate_.baud = has_baud_ ? baud : 0;
  if (!has_baud_) return;
  act(Kind::set_baud);
  actions_.newest().baud = baud;
}

void Session::give_up(std::string reason) {
  reason_ = std::move(reason);
  act(Kind::give_up);
  drop();
}

void Session::wait(Wait what, Clock::duration at_most) {
  waiting_ = what;
  deadline_ = now_ + at_most;
}

Clock::duration Session::wire_time(std::size_t bytes) const {
  return rate_.baud > 0 ? clock_duration(10.0 * static_cast<double>(bytes) / rate_.baud) : Clock::duration{};
}

std::optional<SessionAction> Session::take() { return actions_.take(); }

Clock::duration Session::due_in(Clock::time_point now) const {
  auto due = Clock::time_point::max();
  if (phase_ == SessionPhase::synchronising) due = give_up_at_;
  if (waiting_ != Wait::nothing) due = std::min(due, deadline_);
  if (is_open()) due = std::min(due, last_sent_ + kPulse);
  if (is_open() && phase_ != SessionPhase::raising_baud)
    due = std::min(due, last_sip_ + clock_duration(settings_.lost_s));
  if (due == Clock::time_point::max()) return Clock::duration::max();
  return std::max(Clock::duration{}, due - now);
}

}  // namespace azimuth::pioneer
