#pragma once
#include <functional>
#include <memory>

#include "daemon/pipeline/run_player.hpp"
#include "daemon/pipeline/source.hpp"
#include "drivers/camera/frame.hpp"

namespace azimuth {

/// Reads one image of a recording; valid until the next call. No bytes: it cannot be read.
using ReadFrame = std::function<ImageView(std::size_t index)>;

/// Plays a recording at its own pace. It can wait for perception and the estimator, so nothing is refused or replaced.
///
/// A frame is read when it is due, into the only buffer there is, and nothing is sent after it until perception has
/// given that back: the estimator gets the samples in the order a replay without threads gives them in.
class PlayedSource final : public Source {
 public:
  /// `read_frame` is needed where the recording has frames.
  PlayedSource(Recording recording, double speed, ReadFrame read_frame = {});

  const char* name() const override { return "player"; }
  bool turn(Doorbell& bell, SourceWires& wires) override;
  void restore(const OdometerMemory& /*memory*/) override {}  // a recording has its own origins

 private:
  /// What a leased frame lives in.
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
