#pragma once
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "daemon/pipeline/source.hpp"
#include "drivers/camera/frame.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// The samples of a recorded run, each kind in the order of its stamps. A recording has either bearings or frames.
struct Recording {
  std::vector<OdometryReading> odometry;
  std::vector<BearingSet> bearings;
  std::vector<Stamp> frames = {};  ///< Stamps of the images. The images themselves stay on the disk.
};

/// Plays a recording: tells which sample comes next, and when it is due.
///
/// Samples come in the order of their stamps, and odometry comes before bearings or frames of the same stamp. So the
/// receiver of a bearing set already has all odometry up to that set's stamp, at any speed.
///
/// Thread contract: thread-bound. Nothing allocates after construction.
class RunPlayer {
 public:
  using Clock = std::chrono::steady_clock;

  /// `speed` 1 is the recording's own pace, 2 is twice as fast, 0 is as fast as possible.
  RunPlayer(Recording recording, double speed);

  /// The next sample. Exactly one of the three kinds is present, or none when the recording is over.
  struct Sample {
    const OdometryReading* odometry = nullptr;
    /// The caller may swap the contents of the set away, because the player does not read the set again.
    BearingSet* bearings = nullptr;
    std::optional<std::size_t> frame = {};  ///< index of the image in Recording::frames
    Stamp stamp{};
  };
  Sample peek();

  /// Time until the next sample is due, at most `limit`; zero or negative: it is due now. The first call starts the
  /// clock.
  std::chrono::nanoseconds due_in(Clock::time_point now, std::chrono::nanoseconds limit);

  /// Proceeds to the next sample.
  void advance();

  bool over() const {
    return next_odometry_ == recording_.odometry.size() && next_set_ == recording_.bearings.size() &&
           next_frame_ == recording_.frames.size();
  }

 private:
  Recording recording_;
  double speed_;
  std::size_t next_odometry_ = 0, next_set_ = 0, next_frame_ = 0;
  bool started_ = false;
  Clock::time_point start_{};
  Stamp first_stamp_{};
};

/// Reads one image of a recording by its index. The view is valid until the next call. Without bytes: the image cannot
/// be read.
using ReadFrame = std::function<ImageView(std::size_t index)>;

/// Plays a recording at its own pace. The source can wait for perception and the estimator, so no sample is refused and
/// no frame replaced.
///
/// A frame is read when it is due, into the only buffer. The source sends nothing more until perception has returned
/// the buffer, so the estimator gets the samples in the same order as in a replay without threads.
class PlayedSource final : public Source {
 public:
  /// `read_frame` is required if the recording has frames.
  PlayedSource(Recording recording, double speed, ReadFrame read_frame = {});

  const char* name() const override { return "player"; }
  bool turn(Doorbell& bell, SourceWires& wires) override;
  void restore(const OdometerMemory& /*memory*/) override {}  // the stamps of a recording have their own origins

 private:
  /// The buffer behind the leased frame.
  struct OneBuffer;

  bool hand_over(const RunPlayer::Sample& sample, SourceWires& wires);
  void send_frame(std::size_t index, Stamp stamp, FramesWire& frames);
  bool frame_is_back();

  RunPlayer player_;
  BearingSet set_;
  std::shared_ptr<OneBuffer> buffer_;
  bool frame_is_out_ = false;
};

}  // namespace azimuth
