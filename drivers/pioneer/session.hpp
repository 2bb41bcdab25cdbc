#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "drivers/pioneer/baud_search.hpp"
#include "drivers/pioneer/config_packet.hpp"
#include "drivers/pioneer/message.hpp"
#include "drivers/pioneer/pioneer_settings.hpp"
#include "drivers/pioneer/protocol.hpp"
#include "drivers/pioneer/robot_parameters.hpp"

namespace azimuth::pioneer {

/// How the robot introduces itself.
struct RobotName {
  std::string name, robot_class, subclass;
};

/// What the session wants done with the link, in this order.
struct SessionAction {
  enum class Kind {
    send,         // write `frame`
    set_baud,     // what was written before has left by now
    flush_input,  // forget what arrived and was not looked at
    give_up,      // close the link; reason() says why
    end           // wait until all is sent, then close the link: a clean end
  };
  Kind kind = Kind::send;
  Frame frame;
  int baud = 0;
};

enum class SessionPhase { idle, synchronising, opening, configuring, raising_baud, running, ended };

/// What it takes to go on with a session that another process had.
struct SessionMemory {
  RobotName robot;
  int start_baud = 0, baud = 0;  ///< when it opened, and later; 0: not a serial line
  Clock::time_point heard{};     ///< when the robot was last heard
};

/// The conversation with the controller: finds its baud rate, ends a session somebody left open, synchronises, opens,
/// asks for what odometry needs and keeps the firmware's watchdog quiet. Packets and time in, actions out.
///
/// A session outlives its line: the controller goes on counting. One of our own that is found open soon after the line
/// broke therefore goes on too, and no motion is lost; as long as that can be, nothing is sent that would end it.
///
/// What does not answer over TCP is given up within a second, to be connected to anew: a server that hung may never
/// look at the connection it had. It may as well never listen again once it was hung up on, so the driver keeps that
/// connection beside the new one, and resume_at() goes on with it.
///
/// Reads only: of all commands it knows PULSE, OPEN, CLOSE, CONFIG, ENCODER, SONAR 0, GYRO and HOSTBAUD, none of which
/// moves a wheel or enables a motor.
///
/// Whatever packets come, it goes on or gives up within bounded time, after which begin() starts afresh.
///
/// Thread contract: thread-bound. All actions must be taken after each call; never allocates in phase `running`.
class Session {
 public:
  /// `has_baud`: false for a link that is no serial line.
  Session(const PioneerSettings& settings, bool has_baud);

  /// Before begin(): a session that another process left open is taken for our own. False: its robot is of unknown
  /// kind.
  bool restore(const SessionMemory& memory);
  /// Of the present session; nothing: no other process could go on with it.
  std::optional<SessionMemory> memory() const;

  /// The link was just opened.
  void begin(Clock::time_point now);
  /// Likewise for one that this session had before it fell silent: whatever session is found open there is ours.
  void resume_at(Clock::time_point now);
  void receive(const Message& message, Clock::time_point now);
  /// Lets time pass; to be called when due_in() has passed, at the latest.
  void turn(Clock::time_point now);
  /// Ends cleanly, from any phase.
  void close(Clock::time_point now);
  /// Says no more, and leaves the session open if there is one: the controller goes on counting.
  void leave(Clock::time_point now);
  /// The link broke.
  void drop() {
    phase_ = SessionPhase::idle;
    waiting_ = Wait::nothing;
  }

  /// The next thing to do; nothing: wait.
  std::optional<SessionAction> take();
  /// Time until turn() has something to do; zero when it has already.
  Clock::duration due_in(Clock::time_point now) const;

  SessionPhase phase() const { return phase_; }
  bool is_open() const { return phase_ >= SessionPhase::configuring && phase_ <= SessionPhase::running; }
  const std::string& reason() const { return reason_; }  ///< of the last give_up
  bool refused() const { return refused_; }              ///< it was that the robot is of no kind we know
  int baud() const { return rate_.baud; }                ///< 0: not a serial line

  const RobotName& robot() const { return who_.name; }                       ///< when opening or later
  const RobotParameters& parameters() const { return who_.parameters; }      ///< likewise
  const std::optional<ConfigPacket>& config() const { return who_.config; }  ///< of this session
  bool config_unverified() const { return who_.config_unverified; }
  bool uses_gyro() const { return streams_.wants_gyro; }
  bool baud_refused() const { return rate_.raise_failed; }  ///< the robot did not follow to raised_baud

  std::uint64_t opened() const { return counts_.opened; }    ///< sessions so far; each has its own odometry origin
  std::uint64_t resumed() const { return counts_.resumed; }  ///< times one went on over a new link
  std::uint64_t reboots() const { return counts_.reboots; }  ///< controller restarts noticed
  std::uint64_t old_sessions() const { return counts_.old_sessions; }  ///< sessions found open and closed

 private:
  static constexpr Clock::duration kPulse = std::chrono::milliseconds(500);
  static constexpr std::size_t kCommandSize = 9;  // of the longest command, with its frame
  enum class Wait { nothing, answer, settle, sweep, baud_sent, baud_set };

  void add_start_bauds();
  void start_search();
  void try_baud();
  void try_next_baud();
  void part();
  void sweep();
  void wait_until_sent();
  void settle();
  void synchronise(const Packet& packet);
  bool may_be_ours() const;
  bool is_ours() const;
  void resume();
  void close_old_session();
  void found_open();
  void introduce(ByteView data);
  void refuse();

  void open();
  void opened_now();
  void ask_for_config();
  void configured();
  bool may_raise_baud() const;
  void raise_baud();
  void run();
  void request_streams();
  void repeat_requests();

  void note(const Message& message);
  void rebooted();
  void timed_out();
  void no_answer();
  void keep_alive();

  void send(Command command);
  void send(Command command, int argument);
  void send(const Frame& frame);
  void send_sync(std::uint8_t number);
  void act(SessionAction::Kind kind);
  void set_baud(int baud);
  void give_up(std::string reason);
  void wait(Wait what, Clock::duration at_most);
  Clock::duration wire_time(std::size_t bytes) const;

  PioneerSettings settings_;
  bool has_baud_;
  BaudSearch search_;
  SessionPhase phase_ = SessionPhase::idle;
  Wait waiting_ = Wait::nothing;
  Clock::time_point now_{};  // of the present call
  Clock::time_point deadline_{}, give_up_at_{}, last_sent_{}, last_sip_{}, repeat_at_{};
  std::uint8_t sync_ = 0;
  /// Without an answer.
  struct Tries {
    int of_round = 0;
    int rounds = 0;  // on this line, or over TCP since the last session
    int of_config = 0, repeats = 0;
  };
  Tries tries_;
  std::size_t swept_ = 0;

  /// Of the serial line; 0: it is none, or there was no session yet.
  struct Rate {
    int baud = 0;
    int start = 0, of_session = 0;  // of the newest session: when it opened, and later
    bool raise_failed = false;
  };
  Rate rate_;
  bool opened_here_ = false;  // not by another process, which would have raised its rate
  bool resumable_ = false;    // the controller counts on from where we last heard of it
  bool knows_link_ = false;   // it is the one of our session
  struct Who {
    RobotName name;
    RobotParameters parameters;
    std::optional<ConfigPacket> config;
    bool config_unverified = false;
  };
  Who who_;
  struct Streams {
    bool wants_encoder = false, wants_gyro = false, has_encoder = false, has_gyro = false, has_sonar = false;
  };
  Streams streams_;
  struct Counts {
    std::uint64_t opened = 0, resumed = 0, reboots = 0, old_sessions = 0;
  };
  Counts counts_;
  std::string reason_;
  bool refused_ = false;

  /// What is to be done with the link, oldest first.
  class Actions {
   public:
    /// There must be room.
    SessionAction& add();
    std::optional<SessionAction> take();
    SessionAction& newest() { return ring_[(first_ + count_ - 1) % ring_.size()]; }
    void clear() { first_ = count_ = 0; }

   private:
    std::array<SessionAction, 16> ring_;
    std::size_t first_ = 0, count_ = 0;
  };
  Actions actions_;
};

}  // namespace azimuth::pioneer
