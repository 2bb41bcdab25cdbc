#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/association/direction_matching.hpp"
#include "slam/ceiling/ceiling_view.hpp"
#include "slam/ceiling/lamp_map.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {

/// What the directions of an image are of.
struct LampMatches {
  std::vector<PredictedDirection> predicted;  ///< every lamp above the camera
  std::vector<std::size_t> near;              ///< of those, the ones that some direction may be of
  std::vector<DirectionMatch> of;             ///< each direction, by its place in `near`
  std::uint64_t left_out = 0;                 ///< directions of a crowded image

  /// The lamp of a direction; null: of none.
  const PredictedDirection* paired(std::size_t direction) const {
    const DirectionMatch& match = of[direction];
    return match.fate == DirectionFate::paired ? &predicted[near[as_size(match.landmark)]] : nullptr;
  }
};

/// Which direction is of which lamp.
///
/// What is returned stands until the next call. Thread contract: thread-bound; does not allocate once its workspace has
/// grown to the largest image and map.
class LampMatcher {
 public:
  LampMatcher(const LampEkfSettings& settings, const CeilingView& view);

  /// An image with more directions than there is room for, as of a wet floor or the sun through leaves, becomes a
  /// shorter one.
  const LampMatches& match(CeilingImage& image, std::span<const Lamp> lamps, const LampEkf& ekf);

 private:
  /// A direction of a crowded image, by the confirmed lamp it is nearest to.
  struct Ranked {
    double distance2;
    std::size_t direction;
  };
  void predict(std::span<const Lamp> lamps, const LampEkf& ekf);
  void thin(CeilingImage& image, std::span<const Lamp> lamps);
  void rank_by_confirmed(const CeilingImage& image, std::span<const Lamp> lamps);
  void find_near(const CeilingImage& image, std::span<const Lamp> lamps);
  bool is_near_a_direction(const PredictedDirection& predicted, const CeilingImage& image) const;

  LampEkfSettings settings_;
  double in_view_sr_;
  DirectionGates gates_;
  DirectionMatching matching_;
  LampMatches matches_;

  // Of the running image.
  std::vector<Ranked> ranked_;
  std::vector<Eigen::Vector2d> near_offsets_;
  std::vector<Identity> near_identities_;
  Workspace near_covariance_;
};

}  // namespace azimuth
