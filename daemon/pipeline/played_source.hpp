#pragma once
#include "daemon/pipeline/run_player.hpp"
#include "daemon/pipeline/source.hpp"

namespace azimuth {

/// Plays a recording at its own pace. It can wait for the estimator, so nothing is refused.
class PlayedSource final : public Source {
 public:
  PlayedSource(Recording recording, double speed);

  const char* name() const override { return "player"; }
  bool turn(Doorbell& bell, SourceWires& wires) override;

 private:
  bool hand_over(const RunPlayer::Sample& sample, SourceWires& wires);

  RunPlayer player_;
  BearingSet set_;
};

}  // namespace azimuth
