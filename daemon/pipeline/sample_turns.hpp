#pragma once
// The turns of the threads that bring samples: those of the sources, and that of perception.

#include <atomic>
#include <chrono>

#include "daemon/pipeline/doorbell.hpp"
#include "daemon/pipeline/log_wires.hpp"
#include "daemon/pipeline/perception_stage.hpp"
#include "daemon/pipeline/source.hpp"
#include "daemon/pipeline/wires.hpp"
#include "daemon/publish/painter.hpp"
#include "daemon/record/frame_pace.hpp"

namespace azimuth {

/// The turn of a source's thread. Thread contract: thread-bound; source() only while the thread is at rest.
class SourceTurn {
 public:
  /// `memories` is null when no keeper saves the odometer's state for the next start.
  struct Wires {
    SourceWires samples;
    Newest<OdometerMemory>* memories;
    EndMark& over;
  };

  SourceTurn(Source& source, Wires wires, Doorbell& bell) : source_(source), wires_(wires), bell_(bell) {}

  void operator()();

  Source& source() { return source_; }

 private:
  void hand_over_memory();

  Source& source_;
  Wires wires_;
  Doorbell& bell_;
  OdometerMemory memory_;
  std::chrono::steady_clock::time_point next_memory_{};
};

/// The turn of the perception thread: it takes a frame, sends its bearings to the estimator, and sends copies of the
/// image to the painter and the frame recorder.
///
/// Thread contract: thread-bound.
class PerceptionTurn {
 public:
  struct Wires {
    FramesWire& frames;
    BearingsWire& bearings;
    Newest<PerceptionStatus>& status;
    EndMark &sources_over, &samples_over;
    // The pointers below are null where images are not painted or not recorded.
    Newest<SeenImage>* seen_images;
    std::atomic<Stamp>& shown;
    ImagesWire* kept_images;
  };

  /// Images for the painter are at least `picture_interval` apart. At most `kept_rate_hz` images per second are
  /// recorded; 0: all.
  PerceptionTurn(PerceptionStage& stage, Wires wires, Doorbell& bell, std::chrono::nanoseconds picture_interval,
                 double kept_rate_hz);

  void operator()();

 private:
  void show(const Frame& frame);
  void keep(const Frame& frame);

  PerceptionStage& stage_;
  Wires wires_;
  Doorbell& bell_;
  std::chrono::nanoseconds picture_interval_;
  std::chrono::steady_clock::time_point next_picture_{};
  FramePace pace_;
  Frame frame_;
  BearingSet set_;
  PerceptionStatus news_;
  SeenImage image_;
  KeptImage kept_;
};

}  // namespace azimuth
