#include "drivers/pioneer/session.hpp"

#include <cassert>
#include <utility>

#include "drivers/pioneer/fields.hpp"

namespace azimuth::pioneer {
namespace {

using namespace std::chrono_literals;
using Kind = SessionAction::Kind;

constexpr auto kAnswer = 300ms;    // the longest answer takes 50 ms at 9600 baud
constexpr auto kSynchronise = 8s;  // then give the link up, however lively it is
constexpr int kRounds = 4;         // through all baud rates, without any answer
constexpr int kDislodgeAfter = 3;  // of them: a controller may hang half way through an earlier synchronisation
constexpr auto kSettle = 100ms;    // after CLOSE, until the last packets are through
constexpr auto kFirstSip = 1s;     // after OPEN
constexpr auto kConfigAnswer = 500ms;
constexpr int kConfigTries = 2;
constexpr auto kBaudChange = 10ms;  // before and after, for the controller to follow
constexpr auto kBaudAnswer = 900ms;
constexpr auto kAdapter = 20ms;  // USB adapters hold back what they send
constexpr auto kPulse = 500ms;
constexpr auto kRepeat = 1s;  // a request may be lost as any packet
constexpr int kRepeats = 5;
constexpr std::size_t kCommandSize = 9;

Clock::duration seconds(double s) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
}

bool is_reboot(std::uint8_t id) { return id == packet_id::reboot || id == packet_id::reboot_with_data; }

std::string in_words(const RobotName& robot) {
  return "the robot \"" + robot.name + "\" is of unknown kind \"" + robot.subclass +
         "\" (known: " + known_subclasses() + "); configure its subclass or its conversion";
}

}  // namespace

Session::Session(const PioneerSettings& settings, bool has_baud) : settings_(settings), has_baud_(has_baud) {}

// ---- finding the robot ------------------------------------------------------------------------------------------

void Session::begin(Clock::time_point now) {
  now_ = now;
  first_action_ = action_count_ = 0;
  search_.restart();
  search_.add(session_baud_);  // a session that outlived its link goes on at the rate it had
  search(settings_.baud);
  try_baud();
}

/// From the rates in `search_`, then `start_baud`, on.
void Session::search(int start_baud) {
  search_.add(start_baud);
  if (settings_.baud == 0) {
    search_.add(start_baud_);
    for (const int baud : kControllerBauds) search_.add(baud);
  }
  phase_ = SessionPhase::synchronising;
  rounds_ = 0;
  give_up_at_ = now_ + kSynchronise;
}

void Session::try_baud() {
  set_baud(search_.current());
  act(Kind::flush_input);
  send_sync(kSync0);
}

void Session::try_next_baud() {
  if (search_.advance()) return try_baud();
  if (++rounds_ == kRounds) return give_up("no answer from the robot");
  swept_ = 0;
  if (rounds_ < kDislodgeAfter) return sweep();
  send(Command::open);
  wait_until_sent();
}

/// Says CLOSE at one rate after the other, for a session that was left open at a rate nobody remembers.
void Session::sweep() {
  if (swept_ == (has_baud_ ? kControllerBauds.size() : 1)) return settle();
  if (has_baud_) set_baud(kControllerBauds[swept_]);
  ++swept_;
  send(Command::close);
  wait_until_sent();
}

void Session::wait_until_sent() { wait(Wait::sweep, wire_time(kCommandSize) + kAdapter); }

void Session::settle() { wait(Wait::settle, wire_time(kCommandSize) + kSettle); }

void Session::synchronise(const Packet& packet) {
  if (waiting_ != Wait::answer) return;
  if (packet_id::is_sip(packet.id())) return close_old_session();
  if (packet.id() == packet_id::reboot) return settle();  // it counted differently: from the start
  if (packet.id() != sync_) return;
  if (sync_ == kSync2) return introduce(packet.data.subspan(1));
  send_sync(static_cast<std::uint8_t>(sync_ + 1));
}

/// The controller is in a session already: it goes back to its start rate or stays where it is.
void Session::close_old_session() {
  ++old_sessions_;
  send(Command::close);
  search_.restart();
  search_.add(baud_ == settings_.raised_baud ? start_baud_ : baud_);
  search_.add(baud_);
  search_.add(settings_.baud);
  if (settings_.baud == 0)
    for (const int baud : kControllerBauds) search_.add(baud);
  settle();
}

void Session::introduce(ByteView data) {
  RobotName robot;
  FieldReader reader(data);
  if (!reader.read(robot.name) || !reader.read(robot.robot_class) || !reader.read(robot.subclass)) return;
  robot_ = std::move(robot);
  const auto parameters = robot_parameters(settings_, robot_.subclass);
  if (!parameters) return give_up(in_words(robot_));
  parameters_ = *parameters;
  open();
}

// ---- opening ----------------------------------------------------------------------------------------------------

void Session::open() {
  phase_ = SessionPhase::opening;
  send(Command::open);
  send(Command::pulse);
  wait(Wait::answer, kFirstSip);
}

void Session::opened_now() {
  ++opened_;
  start_baud_ = session_baud_ = baud_;
  last_sip_ = now_;
  phase_ = SessionPhase::configuring;
  config_.reset();
  config_unverified_ = has_sonar_ = wants_encoder_ = wants_gyro_ = has_encoder_ = has_gyro_ = false;
  config_tries_ = 0;
  ask_for_config();
}

void Session::ask_for_config() {
  ++config_tries_;
  send(Command::config);
  send(Command::sonar, 0);  // echoes fill a slow line and nobody looks at them
  wait(Wait::answer, kConfigAnswer);
}

void Session::configured() {
  if (may_raise_baud()) return raise_baud();
  run();
}

/// Only where the controller falls back by itself: another one would be left at a rate its next user does not expect.
bool Session::may_raise_baud() const {
  return has_baud_ && !raise_failed_ && baud_ < settings_.raised_baud && baud_code(settings_.raised_baud) && config_ &&
         config_->auto_baud == ConfigPacket::kAutoBaudResets;
}

void Session::raise_baud() {
  phase_ = SessionPhase::raising_baud;
  send(Command::host_baud, *baud_code(settings_.raised_baud));
  wait(Wait::baud_sent, wire_time(kCommandSize) + kBaudChange);
}

void Session::run() {
  phase_ = SessionPhase::running;
  session_baud_ = baud_;
  waiting_ = Wait::nothing;
  last_sip_ = now_;
  const bool has_ticks_per_mm = settings_.ticks_per_mm > 0.0 || (config_ && config_->ticks_per_mm > 0);
  const bool has_analog_gyro = config_ && config_->gyro == ConfigPacket::kGyroAnalog;
  wants_encoder_ = settings_.encoder != PioneerFeature::off && has_ticks_per_mm;
  wants_gyro_ = settings_.gyro != PioneerFeature::off &&
                (has_analog_gyro || (settings_.gyro == PioneerFeature::on && (!config_ || config_->gyro == 0)));
  repeats_ = 0;
  repeat_at_ = now_ + kRepeat;
  request_streams();
}

void Session::request_streams() {
  if (wants_encoder_ && !has_encoder_) send(Command::encoder, 2);
  if (wants_gyro_ && !has_gyro_) send(Command::gyro, 1);
  if (has_sonar_) send(Command::sonar, 0);
}

void Session::repeat_requests() {
  ++repeats_;
  repeat_at_ = now_ + kRepeat;
  request_streams();
  has_sonar_ = false;
}

// ---- packets and time -------------------------------------------------------------------------------------------

void Session::receive(const Packet& packet, Clock::time_point now) {
  now_ = now;
  const bool is_sip = packet_id::is_sip(packet.id());
  switch (phase_) {
    case SessionPhase::synchronising:
      return synchronise(packet);
    case SessionPhase::opening:
      if (is_reboot(packet.id())) return rebooted();
      if (is_sip) opened_now();
      return;
    case SessionPhase::configuring:
    case SessionPhase::raising_baud:
    case SessionPhase::running:
      return note(packet);
    case SessionPhase::idle:
    case SessionPhase::ended:
      return;
  }
}

void Session::note(const Packet& packet) {
  if (is_reboot(packet.id())) return rebooted();
  if (packet_id::is_sip(packet.id())) {
    last_sip_ = now_;
    constexpr std::size_t kSonarCount = 19;
    has_sonar_ = has_sonar_ || (packet.data.size() > kSonarCount && packet.data[kSonarCount] > 0);
  }
  has_encoder_ = has_encoder_ || packet.id() == packet_id::encoder;
  has_gyro_ = has_gyro_ || packet.id() == packet_id::gyro;
  if (phase_ == SessionPhase::raising_baud && waiting_ == Wait::answer) return run();
  if (config_ || packet.id() != packet_id::config) return;
  config_ = decode_config(packet.data);
  config_unverified_ = config_ && !packet.verified;
  if (config_) configured();
}

/// The controller is back at its start rate and has forgotten the session.
void Session::rebooted() {
  ++reboots_;
  search_.restart();
  search_.add(start_baud_);
  search(baud_);
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
      if (config_tries_ < kConfigTries) return ask_for_config();
      return configured();
    case SessionPhase::raising_baud:
      raise_failed_ = true;
      set_baud(start_baud_);
      send(Command::pulse);
      return run();
    default:
      return;
  }
}

void Session::keep_alive() {
  if (phase_ != SessionPhase::raising_baud && now_ - last_sip_ >= seconds(settings_.lost_s)) {
    send(Command::close);
    return give_up("no odometry from the robot");
  }
  if (phase_ == SessionPhase::running && repeats_ < kRepeats && now_ >= repeat_at_) repeat_requests();
  const bool line_changes = waiting_ == Wait::baud_sent || waiting_ == Wait::baud_set;
  if (!line_changes && now_ - last_sent_ >= kPulse) send(Command::pulse);
}

void Session::close(Clock::time_point now) {
  now_ = now;
  if (is_open()) {
    if (wants_encoder_) send(Command::encoder, 0);
    if (wants_gyro_) send(Command::gyro, 0);
    send(Command::sonar, 0);
  }
  if (is_open() || phase_ == SessionPhase::opening) send(Command::close);
  act(Kind::end);
  phase_ = SessionPhase::ended;
  session_baud_ = 0;
}

// ---- actions ----------------------------------------------------------------------------------------------------

void Session::send(Command command) { send(encode_command(command)); }
void Session::send(Command command, int argument) { send(encode_command(command, argument)); }

void Session::send(const Frame& frame) {
  act(Kind::send);
  newest_action().frame = frame;
  last_sent_ = now_;
}

void Session::send_sync(std::uint8_t number) {
  sync_ = number;
  send(encode_command(number));
  wait(Wait::answer, kAnswer);
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
  return baud_ > 0 ? seconds(10.0 * static_cast<double>(bytes) / baud_) : Clock::duration{};
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
  if (is_open() && phase_ != SessionPhase::raising_baud) due = std::min(due, last_sip_ + seconds(settings_.lost_s));
  if (due == Clock::time_point::max()) return Clock::duration::max();
  return std::max(Clock::duration{}, due - now);
}

}  // namespace azimuth::pioneer
