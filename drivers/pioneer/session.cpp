#include "drivers/pioneer/session.hpp"

#include <cassert>
#include <utility>

#include "drivers/device/device_clock.hpp"

namespace azimuth::pioneer {
namespace {

using Kind = SessionAction::Kind;

using namespace std::chrono_literals;
using Kind = SessionAction::Kind;

constexpr auto kFirstSip = 1s;  // longest time from OPEN to the first SIP
constexpr auto kConfigAnswer = 500ms;
constexpr int kConfigTries = 2;
constexpr auto kBaudChange = 10ms;  // pause before and after a change of the rate, for the controller
constexpr auto kBaudAnswer = 900ms;
constexpr auto kRepeat = 1s;  // a request is repeated after this time, because any packet may be lost
constexpr int kRepeats = 5;

bool is_reboot(std::uint8_t id) { return id == packet_id::reboot || id == packet_id::reboot_with_data; }

}  // namespace

Session::Session(const PioneerSettings& settings, bool has_baud) : settings_(settings), has_baud_(has_baud) {}

void Session::open() {
  phase_ = SessionPhase::opening;
  send(Command::open);
  send(Command::pulse);
  wait(Wait::answer, kFirstSip);
}

void Session::opened_now() {
  ++counts_.opened;
  tries_.rounds = 0;
  rate_.start = rate_.of_session = rate_.baud;
  opened_here_ = true;
  resumable_ = false;
  last_sip_ = now_;
  phase_ = SessionPhase::configuring;
  who_.config.reset();
  who_.config_unverified = streams_.has_sonar = streams_.wants_encoder = streams_.wants_gyro = streams_.has_encoder =
      streams_.has_gyro = false;
  tries_.of_config = 0;
  ask_for_config();
}

void Session::ask_for_config() {
  ++tries_.of_config;
  send(Command::config);
  send(Command::sonar, 0);  // the echoes fill a slow line and are not used
  wait(Wait::answer, kConfigAnswer);
}

void Session::configured() {
  if (may_raise_baud()) return raise_baud();
  run();
}

/// True: the baud rate may be raised. The controller must return to its start rate by itself, or its next user would
/// find it at an unexpected rate.
bool Session::may_raise_baud() const {
  return has_baud_ && opened_here_ && !rate_.raise_failed && rate_.baud < settings_.raised_baud &&
         baud_code(settings_.raised_baud) && who_.config && who_.config->auto_baud == ConfigPacket::kAutoBaudResets;
}

void Session::raise_baud() {
  phase_ = SessionPhase::raising_baud;
  send(Command::host_baud, *baud_code(settings_.raised_baud));
  wait(Wait::baud_sent, wire_time(kCommandSize) + kBaudChange);
}

void Session::run() {
  phase_ = SessionPhase::running;
  rate_.of_session = rate_.baud;
  resumable_ = true;
  waiting_ = Wait::nothing;
  last_sip_ = now_;
  const bool has_ticks_per_mm = settings_.ticks_per_mm > 0.0 || (who_.config && who_.config->ticks_per_mm > 0);
  const bool has_analog_gyro = who_.config && who_.config->gyro == ConfigPacket::kGyroAnalog;
  streams_.wants_encoder = settings_.encoder != PioneerFeature::off && has_ticks_per_mm;
  streams_.wants_gyro =
      settings_.gyro != PioneerFeature::off &&
      (has_analog_gyro || (settings_.gyro == PioneerFeature::on && (!who_.config || who_.config->gyro == 0)));
  tries_.repeats = 0;
  repeat_at_ = now_ + kRepeat;
  request_streams();
}

void Session::request_streams() {
  if (streams_.wants_encoder && !streams_.has_encoder) send(Command::encoder, 2);
  if (streams_.wants_gyro && !streams_.has_gyro) send(Command::gyro, 1);
  if (streams_.has_sonar) send(Command::sonar, 0);
}

void Session::repeat_requests() {
  ++tries_.repeats;
  repeat_at_ = now_ + kRepeat;
  request_streams();
  streams_.has_sonar = false;
}

// ---- packets and time -------------------------------------------------------------------------------------------

void Session::receive(const Message& message, Clock::time_point now) {
  now_ = now;
  switch (phase_) {
    case SessionPhase::synchronising:
      return synchronise(message.packet);
    case SessionPhase::opening:
      if (is_reboot(message.id())) return rebooted();
      if (packet_id::is_sip(message.id())) opened_now();
      return;
    case SessionPhase::configuring:
    case SessionPhase::raising_baud:
    case SessionPhase::running:
      return note(message);
    case SessionPhase::idle:
    case SessionPhase::ended:
      return;
  }
}

void Session::note(const Message& message) {
  if (is_reboot(message.id())) return rebooted();
  if (packet_id::is_sip(message.id())) last_sip_ = now_;
  streams_.has_sonar = streams_.has_sonar || (message.sip() && message.sip()->sonar_count > 0);
  streams_.has_encoder = streams_.has_encoder || message.id() == packet_id::encoder;
  streams_.has_gyro = streams_.has_gyro || message.id() == packet_id::gyro;
  if (phase_ == SessionPhase::raising_baud && waiting_ == Wait::answer) return run();
  if (who_.config || message.id() != packet_id::config) return;
  who_.config = decode_config(message.packet.data);
  who_.config_unverified = who_.config && !message.packet.verified;
  if (who_.config) configured();
}

/// The controller has returned to its start baud rate and has lost the session.
void Session::rebooted() {
  ++counts_.reboots;
  resumable_ = false;
  tries_.rounds = 0;
  search_.restart();
  search_.add(rate_.start != 0 ? rate_.start : rate_.baud);
  start_search();
  settle();
}

void Session::turn(Clock::time_point now) {
  now_ = now;
  if (phase_ == SessionPhase::synchronising && now_ >= give_up_at_) return give_up("the robot does not synchronise");
  if (waiting_ != Wait::nothing && now_ >= deadline_) timed_out();
  if (is_open()) keep_alive();
}

void Session::timed_out() {
  switch (waiting_) {
    case Wait::settle:
      return try_baud();
    case Wait::sweep:
      return sweep();
    case Wait::baud_sent:
      set_baud(settings_.raised_baud);
      act(Kind::flush_input);
      return wait(Wait::baud_set, kBaudChange);
    case Wait::baud_set:
      send(Command::pulse);
      return wait(Wait::answer, kBaudAnswer);
    case Wait::answer:
      break;
    case Wait::nothing:
      return;
  }
  no_answer();
}

void Session::no_answer() {
  switch (phase_) {
    case SessionPhase::synchronising:
      return try_next_baud();
    case SessionPhase::opening:
      send(Command::close);
      return give_up("the robot opens no session");
    case SessionPhase::configuring:
      if (tries_.of_config < kConfigTries) return ask_for_config();
      return configured();
    case SessionPhase::raising_baud:
      rate_.raise_failed = true;
      set_baud(rate_.start);
      send(Command::pulse);
      return run();
    default:
      return;
  }
}

void Session::keep_alive() {
  if (phase_ != SessionPhase::raising_baud && now_ - last_sip_ >= clock_duration(settings_.lost_s))
    return give_up("no odometry from the robot");
  if (phase_ == SessionPhase::running && tries_.repeats < kRepeats && now_ >= repeat_at_) repeat_requests();
  const bool line_changes = waiting_ == Wait::baud_sent || waiting_ == Wait::baud_set;
  if (!line_changes && now_ - last_sent_ >= kPulse) send(Command::pulse);
}

void Session::leave(Clock::time_point now) {
  now_ = now;
  if (!resumable_) return close(now);  // no later process could continue the session
  act(Kind::end);
  phase_ = SessionPhase::ended;
}

void Session::close(Clock::time_point now) {
  now_ = now;
  if (is_open()) {
    if (streams_.wants_encoder) send(Command::encoder, 0);
    if (streams_.wants_gyro) send(Command::gyro, 0);
    send(Command::sonar, 0);
  }
  if (is_open() || phase_ == SessionPhase::opening) send(Command::close);
  act(Kind::end);
  phase_ = SessionPhase::ended;
  rate_.of_session = 0;
  resumable_ = false;
}

// The actions of a session, and the times of its next turn.

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
