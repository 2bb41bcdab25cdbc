// What a session wants done, and when it wants to be asked again.

#include <algorithm>
#include <cassert>
#include <utility>

#include "drivers/device/clock_duration.hpp"
#include "drivers/pioneer/session.hpp"

namespace azimuth::pioneer {

namespace {
using Kind = SessionAction::Kind;
}  // namespace

void Session::send(Command command) { send(encode_command(command)); }
void Session::send(Command command, int argument) { send(encode_command(command, argument)); }

void Session::send(const Frame& frame) {
  act(Kind::send);
  newest_action().frame = frame;
  last_sent_ = now_;
}

void Session::act(Kind kind) {
  assert(action_count_ < actions_.size());
  ++action_count_;
  newest_action().kind = kind;
}

void Session::set_baud(int baud) {
  baud_ = has_baud_ ? baud : 0;
  if (!has_baud_) return;
  act(Kind::set_baud);
  newest_action().baud = baud;
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
  return baud_ > 0 ? clock_duration(10.0 * static_cast<double>(bytes) / baud_) : Clock::duration{};
}

std::optional<SessionAction> Session::take() {
  if (action_count_ == 0) return std::nullopt;
  const SessionAction& action = actions_[first_action_];
  first_action_ = (first_action_ + 1) % actions_.size();
  --action_count_;
  return action;
}

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
