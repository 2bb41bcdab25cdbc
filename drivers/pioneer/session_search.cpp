// Finding the robot: its baud rate, sessions left open, synchronisation.

#include <algorithm>
#include <utility>

#include "base/clocks.hpp"
#include "drivers/pioneer/fields.hpp"
#include "drivers/pioneer/session.hpp"

namespace azimuth::pioneer {
namespace {

using namespace std::chrono_literals;
using Kind = SessionAction::Kind;

constexpr auto kAnswer = 300ms;    // the longest answer takes 50 ms at 9600 baud
constexpr auto kSlowAnswer = 1s;   // over TCP, of a robot that has begun to answer
constexpr auto kSynchronise = 8s;  // then give the link up, however lively it is
constexpr int kRounds = 4;         // through all baud rates, without any answer
constexpr int kDislodgeAfter = 3;  // of them: a controller may hang half way through an earlier synchronisation
constexpr int kTriesOverTcp = 2;   // are a round where there are no baud rates, and all that one connection gets
constexpr auto kSettle = 100ms;    // after CLOSE, until the last packets are through
constexpr double kHalfRange_units = 16384.0;  // of the position counters' 15 reliable bits
constexpr auto kAdapter = 20ms;               // USB adapters hold back what they send
constexpr const char* kNoAnswer = "no answer from the robot";

std::string in_words(const RobotName& robot) {
  return "the robot \"" + robot.name + "\" is of unknown kind \"" + robot.subclass +
         "\"; set daemon.pioneer.subclass to the kind it counts like, or distance_mm_per_unit (known: " +
         known_subclasses() + ")";
}

}  // namespace

bool Session::restore(const SessionMemory& memory) {
  const auto parameters = robot_parameters(settings_, memory.robot.subclass);
  const auto is_baud = [](int baud) {
    return baud == 0 || std::ranges::find(kControllerBauds, baud) != kControllerBauds.end();
  };
  if (!parameters || !is_baud(memory.start_baud) || !is_baud(memory.baud)) return false;
  who_.name = memory.robot;
  who_.parameters = *parameters;
  rate_.start = memory.start_baud;
  rate_.of_session = memory.baud;
  last_sip_ = memory.heard;
  resumable_ = true;
  return true;
}

std::optional<SessionMemory> Session::memory() const {
  if (!resumable_) return std::nullopt;
  return SessionMemory{who_.name, rate_.start, rate_.of_session, last_sip_};
}

void Session::begin(Clock::time_point now) {
  now_ = now;
  actions_.clear();
  search_.restart();
  search_.add(rate_.of_session);  // a session that outlived its link goes on at the rate it had
  add_start_bauds();
  start_search();
  refused_ = false;
  tries_.of_round = 0;
  knows_link_ = false;
  if (has_baud_) tries_.rounds = 0;  // over TCP a link is but one round long
  try_baud();
}

void Session::resume_at(Clock::time_point now) {
  begin(now);
  knows_link_ = true;
}

void Session::add_start_bauds() {
  if (!has_baud_) return;
  search_.add(settings_.baud);
  if (settings_.baud != 0) return;
  search_.add(rate_.start);
  for (const int baud : kControllerBauds) search_.add(baud);
}

void Session::start_search() {
  phase_ = SessionPhase::synchronising;
  give_up_at_ = now_ + kSynchronise;
}

void Session::try_baud() {
  ++tries_.of_round;
  set_baud(search_.current());
  act(Kind::flush_input);
  send_sync(kSync0);
}

void Session::try_next_baud() {
  if (search_.advance() || (!has_baud_ && tries_.of_round < kTriesOverTcp)) return try_baud();
  ++tries_.rounds;
  if (!has_baud_) return part();
  if (tries_.rounds == kRounds) return give_up(kNoAnswer);
  if (may_be_ours()) return try_baud();
  swept_ = 0;
  if (tries_.rounds < kDislodgeAfter) return sweep();
  send(Command::open);
  wait_until_sent();
}

/// What may make the robot answer on the next connection: whatever hinders it ends. It comes last on this one, since
/// servers that hang up on CLOSE take long to listen again unless the client has hung up before.
void Session::part() {
  if (!may_be_ours()) {
    if (tries_.rounds % kDislodgeAfter == 0) send(Command::open);
    send(Command::close);
  }
  give_up(kNoAnswer);
}

/// Says CLOSE at one rate after the other, for a session that was left open at a rate nobody remembers.
void Session::sweep() {
  if (swept_ == kControllerBauds.size()) return settle();
  set_baud(kControllerBauds[swept_++]);
  send(Command::close);
  wait_until_sent();
}

void Session::wait_until_sent() { wait(Wait::sweep, wire_time(kCommandSize) + kAdapter); }

void Session::settle() {
  tries_.of_round = 0;
  wait(Wait::settle, wire_time(kCommandSize) + kSettle);
}

void Session::synchronise(const Packet& packet) {
  if (waiting_ != Wait::answer) return;
  if (packet_id::is_sip(packet.id())) return found_open();
  if (packet.id() == packet_id::reboot) return settle();  // it counted differently: from the start
  if (packet.id() != sync_) return;
  resumable_ = false;  // who synchronises has no session
  if (sync_ == kSync2) return introduce(packet.data.subspan(1));
  send_sync(static_cast<std::uint8_t>(sync_ + 1));
}

/// Whether our session may go on: the line broke so lately that its position cannot have wrapped unseen.
bool Session::may_be_ours() const {
  const double reach_m = settings_.max_speed_m_s * in_seconds(now_ - last_sip_);
  return resumable_ && reach_m < kHalfRange_units * who_.parameters.distance_m_per_unit;
}

/// Whether the session found open is our own.
bool Session::is_ours() const { return may_be_ours() && rate_.baud == rate_.of_session; }

/// One that has been silent for so long that its counters may have wrapped begins another odometry, but is not closed
/// on its own connection: there are servers that hang up on CLOSE, and never listen again.
void Session::found_open() {
  if (is_ours()) return resume();
  if (!knows_link_) return close_old_session();
  opened_now();
}

/// What another process was told of the robot is asked for again; odometry comes meanwhile.
void Session::resume() {
  ++counts_.resumed;
  tries_.rounds = 0;
  if (who_.config) return run();
  phase_ = SessionPhase::configuring;
  last_sip_ = now_;
  tries_.of_config = 0;
  ask_for_config();
}

/// The controller is in a session already: it goes back to its start rate or stays where it is.
void Session::close_old_session() {
  ++counts_.old_sessions;
  resumable_ = false;
  send(Command::close);
  search_.restart();
  search_.add(rate_.baud == settings_.raised_baud ? rate_.start : rate_.baud);
  search_.add(rate_.baud);
  add_start_bauds();
  settle();
}

void Session::introduce(ByteView data) {
  RobotName robot;
  FieldReader reader(data);
  if (!reader.read(robot.name) || !reader.read(robot.robot_class) || !reader.read(robot.subclass)) return;
  who_.name = std::move(robot);
  const auto parameters = robot_parameters(settings_, who_.name.subclass);
  if (!parameters) return refuse();
  who_.parameters = *parameters;
  open();
}

void Session::refuse() {
  give_up(in_words(who_.name));
  refused_ = true;
}

void Session::send_sync(std::uint8_t number) {
  sync_ = number;
  send(encode_command(number));
  wait(Wait::answer, has_baud_ || number == kSync0 ? Clock::duration(kAnswer) : kSlowAnswer);
}

}  // namespace azimuth::pioneer
