#pragma once
// Keeps the images of a camera of this process coming, through opening, silence, failure and reopening, for every kind
// of camera.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/camera/frame.hpp"
#include "drivers/camera/image_stream.hpp"
#include "drivers/device/back_off.hpp"
#include "drivers/device/connection.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// Judges the stamps and sequence numbers of one camera's images over all its streams, so that the delivered ones
/// strictly increase.
///
/// Thread contract: thread-bound. Nothing allocates.
class ImageOrder {
 public:
  using Clock = std::chrono::steady_clock;
  /// Tolerance for stamps in the future: the kernel's clock may be read slightly later than `now`.
  static constexpr Duration kFuture{2'000};
  /// Largest plausible age of an image. An image takes longer from exposure to this process only if the process was
  /// suspended.
  static constexpr Duration kOldest{2'000'000};
  /// After this many consecutive unusable stamps the device evidently uses another clock. From then on the time of
  /// arrival replaces its stamps, which is worse than a stamp but better than no image.
  static constexpr int kMostDropped = 8;

  struct Verdict {
    bool usable = false;
    bool replaced = false;  ///< `stamp` is the time of arrival
    /// The device's sequence number was not greater than the previous one.
    bool restarted = false;
    Stamp stamp{};
    std::uint64_t sequence = 0;  ///< the number to deliver
    std::uint64_t missing = 0;   ///< images missing since the previous image of this stream
  };

  /// Announces that the next image is the first of a new stream.
  void begin_stream();
  /// Records a damaged image. It consumes a sequence number, which then does not count as missing.
  void corrupt() { ++corrupt_; }
  /// Judges an image by the device's number and its stamp on CLOCK_MONOTONIC, at the time `now`.
  Verdict judge(std::uint64_t sequence, Stamp stamp, Clock::time_point now);

 private:
  void judge_sequence(std::uint64_t sequence, Verdict& verdict);
  void judge_stamp(Stamp stamp, Clock::time_point now, Verdict& verdict);

  std::optional<std::uint64_t> device_sequence_;  // number of the previous image in this stream
  std::uint64_t corrupt_ = 0;                     // damaged images since the previous good one
  std::uint64_t sequence_ = 0;                    // the number delivered last, or 0
  bool any_ = false;                              // an image has been delivered
  std::optional<Stamp> newest_;
  int dropped_in_a_row_ = 0;
};

/// When a camera counts as silent, and which image size it must have.
struct CameraDriverSettings {
  /// A camera without a good image for this long, and for four image intervals, counts as silent and is reopened.
  double silent_s = 0.8;
  /// The limit instead of `silent_s` before the first image of a stream, because sensors need time to start.
  double first_image_s = 3.0;
  int width_px = 0;   ///< a camera with another width is refused; 0: any width
  int height_px = 0;  ///< a camera with another height is refused; 0: any height
};

/// The state of a camera. All counters count from the start of the driver.
struct CameraState : DeviceState {
  StreamDescription description;  ///< of the current stream, or of the last one
  /// The USB port (its name in sysfs) of a camera that is present but silent, or that has failed to open several times,
  /// so that only a reset of the port may help. Empty: no reset is wanted. The request stays until an image arrives or
  /// the camera disappears, so the receiver must limit the rate of resets.
  std::string wants_port_reset;

  std::uint64_t images = 0;   ///< delivered images
  std::uint64_t missing = 0;  ///< gaps in the device's sequence numbers, without the corrupt images
  std::uint64_t corrupt = 0;  ///< damaged images, dropped
  /// Stamps replaced by the time of arrival, because they lay in the future or were unusable for long.
  std::uint64_t stamps_replaced = 0;
  /// Images dropped because their stamps went backwards or were too old.
  std::uint64_t stamps_dropped = 0;
  /// Streams that have delivered an image. All but the first are reopenings.
  std::uint64_t openings = 0;
  std::uint64_t silences = 0;  ///< how often the camera became silent
  std::uint64_t reopenings() const { return openings > 0 ? openings - 1 : 0; }
};

/// The driver of a camera, for a thread that polls:
///
///   poll descriptor() for poll_events(), for due_in() at most; then turn();
///   then take() and take_event() until they return false.
///
/// When a camera is unplugged, fails or becomes silent, the driver opens it again by the stable name that the opener
/// uses, with a back-off of at most a second, and at once after wake().
///
/// The stamps and the sequence numbers of the delivered frames strictly increase, even across reopenings. The numbers
/// of a new stream continue after a gap of one, which tells receivers that images were lost; the number of lost
/// images is unknown. Within a stream the gaps are exactly those of the device.
///
/// Thread contract: thread-bound; frames may be destroyed on any thread. Blocks only while the opener blocks or a
/// stream is closed. Nothing allocates while the camera runs.
class CameraDriver {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kMaxUnread = 4;

  /// Does not open the camera yet. An opener that returns neither a stream nor a text of trouble is still working, and
  /// is called again soon.
  CameraDriver(const CameraDriverSettings& settings, StreamOpener open);
  CameraDriver(const CameraDriver&) = delete;
  CameraDriver& operator=(const CameraDriver&) = delete;

  int descriptor() const;     ///< to be polled; -1: none. It may change with every turn.
  short poll_events() const;  ///< events for poll(2)
  /// Time until turn() is needed without any event; never negative.
  Clock::duration due_in(Clock::time_point now) const;

  /// Opens the camera, reads the available images, and detects silence. `now` should be fresh, because stamps are
  /// judged by it.
  void turn(Clock::time_point now);
  /// To be called when a device was plugged in: the driver tries to open the camera at once, and at short intervals
  /// for a while.
  void wake(Clock::time_point now);

  /// Takes the oldest image, and releases the previous contents of `into`. False: there is none, `into` is unchanged.
  /// While kMaxUnread images are not taken, further ones stay in the device.
  bool take(Frame& into);
  /// Takes the oldest message for the log about a change. A repeated trouble is reported only the first time.
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
  bool fresh_ = false;              // the stream was opened in this turn
  Clock::time_point last_image_{};  // time of the last image, or of the opening
  BackOff back_off_;
  // Consecutive failed openings of a camera that is present.
  int hung_openings_ = 0;

  std::array<Frame, kMaxUnread> unread_;
  std::size_t first_unread_ = 0, unread_count_ = 0;
  Frame frame_;
  std::vector<std::string> told_refusals_;
  DeviceNews news_;
  CameraState state_;
};

}  // namespace azimuth
