#pragma once
#include <optional>
#include <vector>

#include "slam/hindsight/mapper.hpp"
#include "slam/smoother/known_names.hpp"

namespace azimuth {

/// Landmarks that the sensor names. Bearings without a name are passed over.
class NamedMapper final : public Mapper {
 public:
  /// A landmark counts as established after so many bearings.
  NamedMapper(const KnownNamesSettings& settings, int established_after);

  bool remember(const MapSnapshot& map, const std::optional<Eigen::Matrix3d>& moved) override;
  void predict(const Motion& motion) override { names_.predict(motion); }
  Heard update(const BearingSet& set) override;
  void bookmark() override { bookmark_ = Bookmark{names_, ids_, next_id_}; }
  void return_to_bookmark() override;
  void place(const PoseGaussian& robot) override;

  PoseGaussian pose() const override { return {names_.pose(), names_.covariance()}; }
  std::span<const HeardBearing> heard() const override { return heard_; }
  std::span<const HindsightLandmark> landmarks() const override { return landmarks_; }
  std::int64_t next_id() const override { return next_id_; }
  const Smoother& smoother() const override { return names_.smoother(); }
  PoseGaussian past(PoseNumber number) const override;
  PoseNumber anchor() const override { return names_.anchor(); }
  Motion since_anchor() const override {
    return names_.since_anchor().moved() ? names_.since_anchor_with_floors() : names_.since_anchor();
  }

 private:
  void give_ids();
  void list_heard();
  void list_landmarks();

  struct Bookmark {
    KnownNames names;
    std::vector<std::int64_t> ids;
    std::int64_t next_id;
  };

  KnownNames names_;
  std::size_t established_after_;
  std::vector<std::int64_t> ids_;        // of each landmark of the graph
  std::vector<std::uint64_t> recalled_;  // sightings of the first ones before the start
  std::int64_t next_id_ = 0;
  std::optional<Bookmark> bookmark_;
  std::vector<HeardBearing> heard_;
  std::vector<HindsightLandmark> landmarks_;
};

}  // namespace azimuth
