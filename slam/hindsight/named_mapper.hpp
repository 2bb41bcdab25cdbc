#pragma once
#include <optional>
#include <unordered_map>
#include <vector>

#include "slam/hindsight/mapper.hpp"
#include "slam/smoother/known_names.hpp"

namespace azimuth {

/// A mapper for landmarks whose identities the sensor reports. Bearings without an identity are ignored. A landmark
/// keeps its id as long as its identity is the same.
///
/// The energy has several minima, and the minimum that is found depends on the weight of outliers while little is
/// known. So several members with different kernels run in parallel; the member with the lowest energy, in a measure
/// that is common to all, gives the results (mathematics VI.22).
class NamedMapper final : public Mapper {
 public:
  /// Makes one member per entry of `members`, at least one. A landmark counts as established after `established_after`
  /// bearings.
  NamedMapper(const std::vector<KnownNamesSettings>& members, int established_after);

  bool remember(const MapSnapshot& map, const std::optional<Eigen::Matrix3d>& moved) override;
  void predict(const Motion& motion) override;
  UpdateOutcome update(const BearingSet& set) override;
  void bookmark() override { bookmark_ = members_; }
  void return_to_bookmark() override;
  void place(const PoseGaussian& robot) override;

  PoseGaussian pose() const override { return {best().pose(), best().covariance()}; }
  std::span<const UsedBearing> heard() const override { return heard_; }
  std::span<const HindsightLandmark> landmarks() const override { return landmarks_; }
  std::int64_t next_id() const override { return next_id_; }
  const Smoother& smoother() const override { return best().smoother(); }
  void conclude() override;
  PoseGaussian past(PoseNumber number) const override;
  const std::vector<PoseNumber>& numbers() const override { return best().numbers(); }
  std::optional<RigBelief> rig() const override { return best().rig(); }
  std::optional<Judgement> doubt() const override;
  PoseNumber anchor() const override { return best().anchor(); }
  Motion since_anchor() const override {
    return best().since_anchor().moved() ? best().since_anchor_with_floors() : best().since_anchor();
  }

 private:
  struct Name {
    std::int64_t id;
    std::uint64_t sightings_before;  ///< number of bearings before the start
  };
  const KnownNames& best() const { return members_[best_]; }
  void choose();
  void judge_rig();
  void forget(const std::vector<PoseId>& poses);
  void list_heard();
  void list_landmarks();

  std::size_t established_after_;
  std::vector<KnownNames> members_, bookmark_;
  std::size_t best_ = 0;
  int images_since_choice_ = 0, images_since_judged_ = 0;
  std::unordered_map<Identity, Name> ids_;
  std::int64_t next_id_ = 0;
  std::vector<UsedBearing> heard_;
  std::vector<HindsightLandmark> landmarks_;
};

}  // namespace azimuth
