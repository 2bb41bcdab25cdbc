#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "slam/hindsight/mapper.hpp"
#include "slam/hindsight/task_runner.hpp"

namespace azimuth {

/// Runs a slow mapper beside the thread that asks for the pose. The mapper's results are available some images later;
/// odometry bridges the gap.
///
/// The delay depends on the images' stamps alone, never on the speed of the machine, so a replay gives the same bits: a
/// caller that asks too early waits. Images that are far apart are processed without delay.
///
/// Thread contract: thread-bound. While the background task runs, only its thread uses the mapper.
class LateMapper final : public Mapper {
 public:
  LateMapper(std::unique_ptr<Mapper> mapper, std::unique_ptr<TaskRunner> runner);
  ~LateMapper() override { runner_->finish(); }

  bool remember(const MapSnapshot& map, const std::optional<Eigen::Matrix3d>& moved) override;
  void predict(const Motion& motion) override;
  UpdateOutcome update(const BearingSet& set) override;
  /// Processes all waiting images first, since they were taken before this pose.
  void place(const PoseGaussian& robot) override;

  PoseGaussian pose() const override;
  std::span<const UsedBearing> heard() const override { return heard_; }
  std::span<const HindsightLandmark> landmarks() const override { return known_.landmarks; }
  std::int64_t next_id() const override { return known_.next_id; }
  const Smoother& smoother() const override { return *known_.smoother; }
  PoseGaussian past(PoseNumber number) const override;
  const std::vector<PoseNumber>& numbers() const override { return known_.numbers; }
  void conclude() override;
  PoseNumber anchor() const override { return known_.anchor; }
  Motion since_anchor() const override;
  std::optional<Judgement> doubt() const override { return known_.doubt; }
  std::optional<Scene> scene() const override { return known_.scene; }
  std::optional<RigBelief> rig() const override { return known_.rig; }
  Calibration calibration() const override { return known_.calibration; }
  Calibration calibration_sigma() const override { return known_.calibration_sigma; }

 private:
  /// An image that is not yet processed, and the motion from the image before it.
  struct Waiting {
    Motion motion;
    BearingSet set;
  };
  /// The mapper's results up to an image.
  struct Known {
    UpdateOutcome heard;  ///< of all images since the last results
    std::vector<UsedBearing> bearings;
    std::vector<HindsightLandmark> landmarks;
    std::int64_t next_id = 0;
    std::optional<Smoother> smoother;
    std::vector<PoseNumber> numbers;
    PoseGaussian pose;
    PoseNumber anchor = 0;
    Motion since_anchor;
    std::optional<Judgement> doubt;
    std::optional<Scene> scene;
    std::optional<RigBelief> rig;
    Calibration calibration = Calibration::Zero(), calibration_sigma = Calibration::Zero();
  };
  void look_at_all();
  void look_at_waiting();
  void adopt();
  void learn(Known& known) const;

  std::unique_ptr<Mapper> mapper_;
  std::unique_ptr<TaskRunner> runner_;
  std::vector<Waiting> waiting_, under_way_;
  std::size_t count_waiting_ = 0;
  std::optional<Stamp> last_image_, begun_;
  Motion since_waiting_;  ///< since the newest waiting image
  Known known_, next_;
  std::vector<UsedBearing> heard_;   ///< bearings not yet reported
  std::vector<Motion> after_known_;  ///< one per image after the last one with results
};

}  // namespace azimuth
