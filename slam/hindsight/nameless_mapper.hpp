#pragma once
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "slam/hindsight/mapper.hpp"
#include "slam/hypotheses/nameless.hpp"

namespace azimuth {

/// A mapper for landmarks that all look alike. A beam of hypotheses decides the data association; identities of
/// bearings are ignored. The id of a landmark is the number of its first bearing.
///
/// The landmarks are those of the best hypothesis; the pose is that of all hypotheses.
class NamelessMapper final : public Mapper {
 public:
  NamelessMapper(const NamelessSettings& settings, std::unique_ptr<Workers> workers);

  /// Returns false without `moved`, since landmarks that all look alike do not reveal the robot's pose.
  bool remember(const MapSnapshot& map, const std::optional<Eigen::Matrix3d>& moved) override;
  void predict(const Motion& motion) override { nameless_.predict(motion); }
  UpdateOutcome update(const BearingSet& set) override;

  void place(const PoseGaussian& robot) override;

  PoseGaussian pose() const override;
  std::span<const UsedBearing> heard() const override { return heard_; }
  std::span<const HindsightLandmark> landmarks() const override { return landmarks_; }
  std::int64_t next_id() const override { return nameless_.bearings_so_far(); }
  const Smoother& smoother() const override { return concluded_ ? *concluded_ : nameless_.beam().best().smoother(); }
  void conclude() override;
  PoseGaussian past(PoseNumber number) const override;
  const std::vector<PoseNumber>& numbers() const override { return nameless_.numbers(); }
  std::optional<RigBelief> rig() const override;
  Calibration calibration() const override { return nameless_.rig_errors().believable(); }
  Calibration calibration_sigma() const override { return nameless_.rig_errors().sigma; }
  std::optional<Judgement> doubt() const override;
  std::optional<Scene> scene() const override { return nameless_.beam().best().scene(); }
  PoseNumber anchor() const override { return nameless_.anchor(); }
  Motion since_anchor() const override {
    return nameless_.since_anchor().moved() ? nameless_.since_anchor_with_floors() : nameless_.since_anchor();
  }

 private:
  /// The id of a landmark whose first bearing was removed or lies before the start, and the number of its removed
  /// bearings.
  struct Known {
    std::int64_t id = 0;
    std::uint64_t forgotten_sightings = 0;
  };
  void list_landmarks();
  std::int64_t first_bearing_of(LandmarkId landmark) const;
  Known known(LandmarkId landmark) const;
  void forget();
  void list_heard();

  Nameless nameless_;
  std::unique_ptr<Workers> workers_;
  std::vector<Known> remembered_;        // landmarks of a saved map, by their number in the graph
  std::map<std::int64_t, Known> known_;  // by the number of the first remaining bearing
  std::optional<Smoother> concluded_;    // the best hypothesis's; empty until conclude()
  std::vector<UsedBearing> heard_;
  std::vector<HindsightLandmark> landmarks_;
};

}  // namespace azimuth
