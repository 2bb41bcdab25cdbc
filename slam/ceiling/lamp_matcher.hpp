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

/// The data association of an image's directions with lamps.
struct LampMatches {
  std::vector<PredictedDirection> predicted;  ///< Every lamp above the camera
  std::vector<std::size_t> near;              ///< Indices in `predicted` of the lamps in the gate of some direction
  std::vector<DirectionMatch> of;             ///< For each direction, its match, as an index into `near`
  std::uint64_t left_out = 0;                 ///< Number of directions of a crowded image that were left out

  /// The lamp matched with a direction, or null.
  const PredictedDirection* paired(std::size_t direction) const {
    const DirectionMatch& match = of[direction];
    return match.fate == DirectionFate::paired ? &predicted[near[as_size(match.landmark)]] : nullptr;
  }
};

/// Matches directions with lamps.
///
/// The result of match() is valid until its next call. Thread contract: thread-bound; does not allocate once the
/// workspace has grown to the largest image and map.
class LampMatcher {
 public:
  LampMatcher(const LampEkfSettings& settings, const CeilingView& view);

  /// Matches `image`. An image with more directions than LampEkfSettings::max_directions (for example of a wet floor,
  /// or of the sun through leaves) is shortened.
  const LampMatches& match(CeilingImage& image, std::span<const Lamp> lamps, const LampEkf& ekf);

 private:
  /// A direction of a crowded image, with its distance from the nearest confirmed lamp.
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

  // Workspace of the current image.
  std::vector<Ranked> ranked_;
  std::vector<Eigen::Vector2d> near_offsets_;
  std::vector<Identity> near_identities_;
  Workspace near_covariance_;
};

}  // namespace azimuth
