#pragma once
// Whatever a camera of this process does, its images go on: opening, silence, failure and opening anew, for every kind.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/camera/frame.hpp"
#include "drivers/camera/image_order.hpp"
#include "drivers/camera/image_stream.hpp"
#include "drivers/device/back_off.hpp"
#include "drivers/device/connection.hpp"
#include "drivers/device/device_news.hpp"

namespace azimuth {

/// When a camera counts as silent, and what its images have to look like.
struct CameraDriverSettings {
  double silent_s = 0.8;       ///< without a good image for so long, and for four intervals: silent, opened anew
  double first_image_s = 3.0;  ///< likewise before a stream's first one: sensors need time to wake up
  int width_px = 0;            ///< a camera that gives another width is refused; 0: any
  int height_px = 0;           ///< likewise its height
};

/// What is known of a camera. All counters count from the start of the driver.
struct CameraState : DeviceState {
  StreamDescription description;  ///< of the present stream, or of the last
  /// The USB port, as sysfs names it, of a camera that is there but silent, or answers again and again that it cannot
  /// be opened: only a reset of the port may help. Empty: no wish. It stands until an image comes or the camera goes,
  /// so whoever grants it has to limit how often.
  std::string wants_port_reset;

  std::uint64_t images = 0;             ///< handed on
  std::uint64_t missing = 0;            ///< gaps in the device's sequence numbers that are not `corrupt` ones
  std::uint64_t corrupt = 0;            ///< damaged ones, dropped
  std::uint64_t stamps_replaced = 0;    ///< stamps of the future, or of no use for long: time of arrival instead
  std::uint64_t stamps_dropped = 0;     ///< images with stamps that went backwards or were too old, dropped
  std::uint64_t sequence_restarts = 0;  ///< sequence numbers that went backwards or stood still within a stream
  std::uint64_t openings = 0;           ///< streams that have given an image; all but the first are reopenings
  std::uint64_t silences = 0;           ///< times the camera was found silent
  std::uint64_t reopenings() const { return openings > 0 ? openings - 1 : 0; }
};

/// A camera for a thread that polls:
///
///   poll descriptor() for poll_events(), for due_in() at most; turn(); take() and take_event() until they say no.
///
/// A camera that is unplugged, fails or falls silent ends nothing: it is opened again, by whatever stable name the
/// opener goes by, with a back-off of at most a second, and at once after wake().
///
/// Frames come with stamps that strictly ascend and sequence numbers that do so too, over reopenings as well: a new
/// stream's numbers go on with a gap of one after the last stream's, so that followers see that images were lost; how
/// many nobody knows. Within a stream gaps are exactly the device's own.
///
/// Thread contract: thread-bound; frames may die elsewhere. Blocks only while the opener does or a stream is closed.
/// Nothing allocates while the camera runs.
class CameraDriver {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kMaxUnread = 4;

  /// Opens nothing yet. An opener that returns neither a stream nor a trouble's text is still at work: it is asked
  /// again soon.
  CameraDriver(const CameraDriverSettings& settings, StreamOpener open);
  CameraDriver(const CameraDriver&) = delete;
  CameraDriver& operator=(const CameraDriver&) = delete;

  int descriptor() const;                               ///< -1: none at present. May change with every turn
  short poll_events() const;                            ///< what to poll(2) it for
  Clock::duration due_in(Clock::time_point now) const;  ///< until turn() is wanted without any event; never negative

  /// Opens, reads what is there and finds out about silence. `now` should be fresh: stamps are judged by it.
  void turn(Clock::time_point now);
  /// Something was plugged in: the camera is tried at once and eagerly for a while.
  void wake(Clock::time_point now);

  /// The oldest image not taken yet; what `into` held before is released. False: none, `into` unchanged. As long as
  /// kMaxUnread are not taken, further ones stay with the device.
  bool take(Frame& into);
  /// A sentence for the log about a change, oldest first. Of repeated trouble only the first time is told.
  bool take_event(std::string& event) { return news_.take(event); }

  const CameraState& state() const { return state_; }

 private:
  void open(Clock::time_point now);
  void accept(std::unique_ptr<ImageStream> stream, Clock::time_point now);
  std::optional<std::string> size_trouble(const StreamDescription& description) const;
  void read(Clock::time_point now);
  void receive(Frame frame, Clock::time_point now);
  void watch_silence(Clock::time_point now);
  void fail(Connection into, const std::string& trouble, Clock::time_point now);
  void judge_opening(const CameraTrouble& trouble);
  void begin_running();
  Clock::duration patience() const;
  void tell_refusals();

  CameraDriverSettings settings_;
  StreamOpener open_;
  std::unique_ptr<ImageStream> stream_;
  ImageOrder order_;
  bool fresh_ = false;              // the stream: opened in this turn
  Clock::time_point last_image_{};  // or the opening
  BackOff back_off_;
  int hung_openings_ = 0;  // in a row, of a camera that is there

  std::array<Frame, kMaxUnread> unread_;
  std::size_t first_unread_ = 0, unread_count_ = 0;
  Frame frame_;
  std::vector<std::string> told_refusals_;
  DeviceNews news_;
  CameraState state_;
};

}  // namespace azimuth
