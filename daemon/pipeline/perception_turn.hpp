#pragma once
#include <atomic>
#include <chrono>

#include "daemon/pipeline/doorbell.hpp"
#include "daemon/pipeline/end_mark.hpp"
#include "daemon/pipeline/log_wires.hpp"
#include "daemon/pipeline/perception_stage.hpp"
#include "daemon/pipeline/source.hpp"
#include "daemon/pipeline/wires.hpp"
#include "daemon/publish/painter.hpp"
#include "daemon/record/frame_pace.hpp"

namespace azimuth {

/// What the perception's thread does: an image in, its bearings out, and copies of it for those who draw and record.
///
/// Thread contract: thread-bound.
class PerceptionTurn {
 public:
  struct Wires {
    FramesWire& frames;
    BearingsWire& bearings;
    Newest<PerceptionStatus>& status;
    EndMark &sources_over, &samples_over;
    // Null where nobody draws or records.
    Newest<SeenImage>* seen_images;
    std::atomic<Stamp>& shown;
    ImagesWire* kept_images;
  };

  /// Pictures come `picture_interval` apart; of the images at most `kept_rate_hz` are recorded, 0: all.
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
