// The search for the robot: its baud rate, sessions left open, synchronisation.

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
constexpr auto kSlowAnswer = 1s;   // over TCP, for a robot that has started to answer
constexpr auto kSynchronise = 8s;  // after this time the link is given up, even if it delivers bytes
constexpr int kRounds = 4;         // rounds through all baud rates without an answer
// After this many rounds OPEN is sent, because a controller may hang in the middle of an earlier synchronisation.
constexpr int kDislodgeAfter = 3;
// Tries that make a round on a link without baud rates; a TCP connection gets only one round.
constexpr int kTriesOverTcp = 2;
constexpr auto kSettle = 100ms;               // after CLOSE, until the last packets have arrived
constexpr double kHalfRange_units = 16384.0;  // half the range of the position counters' 15 reliable bits
constexpr auto kAdapter = 20ms;               // for USB adapters, which delay their output
constexpr const char* kNoAnswer = "no answer from the robot";

std::string in_words(const RobotName& robot) {
  return "the robot \"" + robot.name + "\" is of unknown kind \"" + robot.subclass +
         "\"; set daemon.pioneer.subclass to the kind that it counts like (known: " + known_subclasses() + ")";
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
  search_.add(rate_.of_session);  // a session that outlived its link continues at the baud rate it had
  add_start_bauds();
  start_search();
  refused_ = false;
  tries_.of_round = 0;
  knows_link_ = false;
  if (has_baud_) tries_.rounds = 0;  // a TCP link lasts only one round
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

/// Sends what may make the robot answer on the next connection, because it ends a session that could prevent an answer.
/// This is the last transmission on the link: a server that closes the connection on CLOSE accepts the next one only
/// after a long time, unless the client closed it first.
void Session::part() {
  if (!may_be_ours()) {
    if (tries_.rounds % kDislodgeAfter == 0) send(Command::open);
    send(Command::close);
  }
  give_up(kNoAnswer);
}

/// Sends CLOSE at each baud rate in turn, to end a session that was left open at an unknown rate.
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
  if (packet.id() == packet_id::reboot) return settle();  // the controller expected another sync number: start again
  if (packet.id() != sync_) return;
  resumable_ = false;  // a controller that synchronises has no session
  if (sync_ == kSync2) return introduce(packet.data.subspan(1));
  send_sync(static_cast<std::uint8_t>(sync_ + 1));
}

/// True: this object's session may continue, because the line broke so recently that the position counters cannot
/// have wrapped unnoticed.
bool Session::may_be_ours() const {
  const double reach_m = settings_.max_speed_m_s * in_seconds(now_ - last_sip_);
  return resumable_ && reach_m < kHalfRange_units * who_.parameters.distance_m_per_unit;
}

/// True: the open session that was found is this object's own.
bool Session::is_ours() const { return may_be_ours() && rate_.baud == rate_.of_session; }

/// A session that was silent for so long that its counters may have wrapped starts another odometry. On the connection
/// on which it was opened it is not closed, because some servers close the connection on CLOSE and never accept another
/// one.
void Session::found_open() {
  if (is_ours()) return resume();
  if (!knows_link_) return close_old_session();
  opened_now();
}

/// Continues the session. The configuration of a session of another process is requested again; odometry arrives
/// meanwhile.
void Session::resume() {
  ++counts_.resumed;
  tries_.rounds = 0;
  if (who_.config) return run();
  phase_ = SessionPhase::configuring;
  last_sip_ = now_;
  tries_.of_config = 0;
  ask_for_config();
}

/// Closes a session that another program left open. The controller then returns to its start baud rate, or keeps the
/// current one.
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
