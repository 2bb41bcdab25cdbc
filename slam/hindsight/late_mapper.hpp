#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "slam/hindsight/errand.hpp"
#include "slam/hindsight/mapper.hpp"

namespace azimuth {

/// A mapper that takes its time beside the thread that asks for the pose: what it makes of images is known some images
/// later, and odometry bridges what lies between.
///
/// How much later depends on the images' stamps alone, never on how fast the machine is, so a replay gives the same
/// bits: whoever asks too early waits. Images that are far apart leave time enough, and are not late at all.
///
/// Thread contract: thread-bound. The mapper behind it is used by the errand's thread, and by none other meanwhile.
class LateMapper final : public Mapper {
 public:
  LateMapper(std::unique_ptr<Mapper> mapper, std::unique_ptr<Errand> errand);
  ~LateMapper() override { errand_->finish(); }

  bool remember(const MapSnapshot& map, const std::optional<Eigen::Matrix3d>& moved) override;
  void predict(const Motion& motion) override;
  UpdateOutcome update(const BearingSet& set) override;
  /// All images that wait are of before, and are looked at first.
  void place(const PoseGaussian& robot) override;

  PoseGaussian pose() const override;
  std::span<const HeardBearing> heard() const override { return heard_; }
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

 private:
  /// An image that has not been looked at, and the way there from the one before.
  struct Waiting {
    Motion motion;
    BearingSet set;
  };
  /// What the mapper makes of all up to an image.
  struct Known {
    UpdateOutcome heard;  ///< of all images since the last time
    std::vector<HeardBearing> bearings;
    std::vector<HindsightLandmark> landmarks;
    std::int64_t next_id = 0;
    std::optional<Smoother> smoother;
    std::vector<PoseNumber> numbers;
    PoseGaussian pose;
    PoseNumber anchor = 0;
    Motion since_anchor;
    std::optional<Judgement> doubt;
    std::optional<Scene> scene;
  };
  void look_at_all();
  void look_at_waiting();
  void adopt();
  void learn(Known& known) const;

  std::unique_ptr<Mapper> mapper_;
  std::unique_ptr<Errand> errand_;
  std::vector<Waiting> waiting_, under_way_;
  std::size_t count_waiting_ = 0;
  std::optional<Stamp> last_image_, begun_;
  Motion since_waiting_;  ///< since the newest image that waits
  Known known_, next_;
  std::vector<HeardBearing> heard_;  ///< told once
  std::vector<Motion> after_known_;  ///< one for each image after the one that is known
};

}  // namespace azimuth
