#pragma once
#include <functional>
#include <memory>

#include "daemon/pipeline/run_player.hpp"
#include "daemon/pipeline/source.hpp"
#include "drivers/camera/frame.hpp"

namespace azimuth {

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
