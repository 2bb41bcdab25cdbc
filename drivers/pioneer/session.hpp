#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "drivers/pioneer/config_packet.hpp"
#include "drivers/pioneer/motion_packets.hpp"
#include "drivers/pioneer/pioneer_settings.hpp"
#include "drivers/pioneer/protocol.hpp"
#include "drivers/pioneer/robot_parameters.hpp"

namespace azimuth::pioneer {

/// All baud rates of a controller, the most frequent start rates first.
inline constexpr std::array kControllerBauds{9600, 38400, 115200, 19200, 57600};

/// A short list of rates without repetitions. It has one entry of 0 for a link without a baud rate.
class BaudSearch {
 public:
  void restart() { count_ = at_ = 0; }
  /// Ignores 0 and rates already in the list.
  void add(int baud) {
    const auto all = std::span(bauds_).first(count_);
    if (baud != 0 && count_ < bauds_.size() && std::ranges::find(all, baud) == all.end()) bauds_[count_++] = baud;
  }
  int current() const { return count_ > 0 ? bauds_[at_] : 0; }
  /// Goes to the next rate. False: the end was reached, and the list starts again.
  bool advance() {
    if (++at_ < count_) return true;
    at_ = 0;
    return false;
  }

 private:
  std::array<int, kControllerBauds.size() + 3> bauds_{};
  std::size_t count_ = 0, at_ = 0;
};

/// The robot's identification.
struct RobotName {
  std::string name, robot_class, subclass;
};

/// An action that the session requests on the link. Actions are carried out in the order of their requests.
struct SessionAction {
  enum class Kind {
    send,         // write `frame`
    set_baud,     // all bytes written before have left by now
    flush_input,  // discard received bytes that were not processed
    give_up,      // close the link; reason() tells why
    end           // wait until everything is sent, then close the link: a clean end
  };
  Kind kind = Kind::send;
  Frame frame;
  int baud = 0;
};

enum class SessionPhase { idle, synchronising, opening, configuring, raising_baud, running, ended };

/// The state needed to continue the session of another process.
struct SessionMemory {
  RobotName robot;
  int start_baud = 0, baud = 0;  ///< baud rate at the opening of the session, and later; 0: not a serial line
  Clock::time_point heard{};     ///< when the robot was last heard
};

/// The conversation with the controller. It finds the baud rate, ends a session that another program left open,
/// synchronises, opens the session, requests the packets for odometry, and feeds the firmware's watchdog. Its inputs
/// are packets and time, its outputs are actions.
///
/// A session survives a broken line, because the controller continues to count. So a session of this object that is
/// still open soon after the line broke is continued, and no motion is lost. As long as that is possible, nothing is
/// sent that would end it.
///
/// A TCP connection without an answer is given up within a second and replaced by a new one, because a server that hung
/// may never serve the old connection again. It may also never accept a new one after a hang-up, so the driver keeps
/// the old connection beside the new one, and resume_at() continues with it.
///
/// The session only reads. Of all commands it uses PULSE, OPEN, CLOSE, CONFIG, ENCODER, SONAR 0, GYRO and HOSTBAUD,
/// none of which moves a wheel or enables a motor.
///
/// Regardless of the received packets, the session succeeds or gives up within bounded time. After it gave up, begin()
/// starts again.
///
/// Thread contract: thread-bound. All actions must be taken after each call; never allocates in phase `running`.
class Session {
 public:
  /// `has_baud` is false for a link that is not a serial line.
  Session(const PioneerSettings& settings, bool has_baud);

  /// Called before begin(). An open session of another process is then treated as this object's own. False: its robot
  /// is of unknown kind.
  bool restore(const SessionMemory& memory);
  /// The memory of the current session; none: no other process could continue it.
  std::optional<SessionMemory> memory() const;

  /// To be called when the link has been opened.
  void begin(Clock::time_point now);
  /// Like begin(), for a connection that this session had before it fell silent. A session that is found open on it is
  /// this object's own.
  void resume_at(Clock::time_point now);
  void receive(const Message& message, Clock::time_point now);
  /// Checks timeouts. To be called when due_in() has passed, at the latest.
  void turn(Clock::time_point now);
  /// Ends the session cleanly, from any phase.
  void close(Clock::time_point now);
  /// Sends nothing more, and leaves an open session open, so that the controller continues to count.
  void leave(Clock::time_point now);
  /// To be called when the link is broken.
  void drop() {
    phase_ = SessionPhase::idle;
    waiting_ = Wait::nothing;
  }

  /// The next action; none: wait.
  std::optional<SessionAction> take();
  /// Time until turn() has something to do; zero when it is due.
  Clock::duration due_in(Clock::time_point now) const;

  SessionPhase phase() const { return phase_; }
  bool is_open() const { return phase_ >= SessionPhase::configuring && phase_ <= SessionPhase::running; }
  /// The reason of the last give_up.
  const std::string& reason() const { return reason_; }
  /// True: the reason was that the robot is of an unknown kind.
  bool refused() const { return refused_; }
  /// 0: not a serial line.
  int baud() const { return rate_.baud; }

  /// Valid in phase `opening` or later.
  const RobotName& robot() const { return who_.name; }
  /// Valid in phase `opening` or later.
  const RobotParameters& parameters() const { return who_.parameters; }
  /// The configuration of this session.
  const std::optional<ConfigPacket>& config() const { return who_.config; }
  bool config_unverified() const { return who_.config_unverified; }
  bool uses_gyro() const { return streams_.wants_gyro; }
  /// True: the robot did not follow to raised_baud.
  bool baud_refused() const { return rate_.raise_failed; }

  /// Number of sessions so far. Each has an odometry origin of its own.
  std::uint64_t opened() const { return counts_.opened; }
  /// How often a session continued over a new link.
  std::uint64_t resumed() const { return counts_.resumed; }
  /// Controller restarts noticed.
  std::uint64_t reboots() const { return counts_.reboots; }
  /// Sessions that were found open and closed.
  std::uint64_t old_sessions() const { return counts_.old_sessions; }

 private:
  static constexpr Clock::duration kPulse = std::chrono::milliseconds(500);
  static constexpr std::size_t kCommandSize = 9;  // size of the longest command, with its frame
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
  Clock::time_point now_{};  // time of the current call
  Clock::time_point deadline_{}, give_up_at_{}, last_sent_{}, last_sip_{}, repeat_at_{};
  std::uint8_t sync_ = 0;
  /// Attempts without an answer.
  struct Tries {
    int of_round = 0;
    int rounds = 0;  // rounds through all baud rates on this line, or over TCP since the last session
    int of_config = 0, repeats = 0;
  };
  Tries tries_;
  std::size_t swept_ = 0;

  /// The baud rate of the serial line; 0: not a serial line, or no session yet.
  struct Rate {
    int baud = 0;
    int start = 0, of_session = 0;  // rates of the newest session: at its opening, and later
    bool raise_failed = false;
  };
  Rate rate_;
  // The session was opened by this object, not by a process that would have raised the baud rate.
  bool opened_here_ = false;
  // The controller continues to count from its last known values.
  bool resumable_ = false;
  // The link is the one on which the session was opened.
  bool knows_link_ = false;
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

  /// The requested actions, oldest first.
  class Actions {
   public:
    /// Requires room.
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
