// Finding the robot: its baud rate, sessions left open, synchronisation.

#include <utility>

#include "drivers/pioneer/fields.hpp"
#include "drivers/pioneer/session.hpp"

namespace azimuth::pioneer {
namespace {

using namespace std::chrono_literals;
using Kind = SessionAction::Kind;

constexpr auto kAnswer = 300ms;    // the longest answer takes 50 ms at 9600 baud
constexpr auto kSynchronise = 8s;  // then give the link up, however lively it is
constexpr int kRounds = 4;         // through all baud rates, without any answer
constexpr int kDislodgeAfter = 3;  // of them: a controller may hang half way through an earlier synchronisation
constexpr auto kSettle = 100ms;    // after CLOSE, until the last packets are through
constexpr double kHalfRange_units = 16384.0;  // of the position counters' 15 reliable bits
constexpr auto kAdapter = 20ms;               // USB adapters hold back what they send

std::string in_words(const RobotName& robot) {
  return "the robot \"" + robot.name + "\" is of unknown kind \"" + robot.subclass +
         "\" (known: " + known_subclasses() + "); configure its subclass or its conversion";
}

}  // namespace

void Session::begin(Clock::time_point now) {
  now_ = now;
  first_action_ = action_count_ = 0;
  search_.restart();
  search_.add(session_baud_);  // a session that outlived its link goes on at the rate it had
  add_start_bauds();
  start_search();
  try_baud();
}

void Session::add_start_bauds() {
  search_.add(settings_.baud);
  if (settings_.baud != 0) return;
  search_.add(start_baud_);
  for (const int baud : kControllerBauds) search_.add(baud);
}

void Session::start_search() {
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
  resumable_ = false;  // what follows ends a session, or begins one, whether its answer is heard or not
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
  if (packet_id::is_sip(packet.id())) return is_ours() ? resume() : close_old_session();
  if (packet.id() == packet_id::reboot) return settle();  // it counted differently: from the start
  if (packet.id() != sync_) return;
  if (sync_ == kSync2) return introduce(packet.data.subspan(1));
  send_sync(static_cast<std::uint8_t>(sync_ + 1));
}

/// The session found open is the one whose line broke, and so lately that its position cannot have wrapped unseen.
bool Session::is_ours() const {
  const double reach_m = settings_.max_speed_m_s * std::chrono::duration<double>(now_ - last_sip_).count();
  return resumable_ && baud_ == session_baud_ && reach_m < kHalfRange_units * parameters_.distance_m_per_unit;
}

void Session::resume() {
  ++resumed_;
  run();
}

/// The controller is in a session already: it goes back to its start rate or stays where it is.
void Session::close_old_session() {
  ++old_sessions_;
  send(Command::close);
  search_.restart();
  search_.add(baud_ == settings_.raised_baud ? start_baud_ : baud_);
  search_.add(baud_);
  add_start_bauds();
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

void Session::send_sync(std::uint8_t number) {
  sync_ = number;
  send(encode_command(number));
  wait(Wait::answer, kAnswer);
}

}  // namespace azimuth::pioneer
