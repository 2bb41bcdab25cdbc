#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam/ekf/bearing_ekf.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/planar/ekf_settings.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Finds landmarks that were mapped twice, where bearings carry no names. A second entry is made when the first one was
/// predicted badly for a while. Afterwards both entries compete for the same bearings: at the same place, one is seen
/// and the other is not. Two distinct landmarks that are close together are sooner or later both seen in one image.
///
/// Each landmark therefore counts the images in which a twin (a near landmark of the same kind) was seen instead of it,
/// minus the images in which it was seen itself. A landmark seen in less than half of these images is taken for a
/// duplicate of its twin. Only landmarks of a known kind have twins: if all landmarks are alike, a near one is as
/// likely to be a distinct landmark.
///
/// Thread contract: thread-bound. The storage is bounded by the landmarks that have twins.
class Duplicates {
 public:
  explicit Duplicates(const MergingSettings& settings) : settings_(settings) { missed_.reserve(kTypicalLandmarks); }

  /// A landmark mapped as a point.
  struct Point {
    std::int64_t id;
    Kind kind;
    Index block;
    std::uint64_t sightings;  ///< Number of bearings so far
    bool seen;                ///< The present image shows it
  };
  struct Pair {
    std::int64_t keep, drop;  ///< Identifiers; the landmark seen more often is kept
    bool agree;               ///< The two estimates are compatible; otherwise the dropped one was mapped wrongly
  };

  /// Counts the landmarks that were seen and missed in an image.
  void observe(const BearingEkf& ekf, std::span<const Point> points);
  /// A pair of points that must be the same landmark, if there is one.
  std::optional<Pair> find(const BearingEkf& ekf, std::span<const Point> points) const;

  /// To be called when a landmark is removed from the map.
  void forget(std::int64_t id) {
    std::erase_if(missed_, [id](const Missed& missed) { return missed.id == id; });
  }

 private:
  struct Missed {
    std::int64_t id;
    int images;  ///< Images in which a twin was seen instead, minus those in which it was seen
  };
  int missed(std::int64_t id) const;
  void raise(std::int64_t id);
  bool are_twins(const BearingEkf& ekf, const Point& a, const Point& b) const;
  const Point* better_twin(const BearingEkf& ekf, std::span<const Point> points, const Point& of) const;
  void count(const BearingEkf& ekf, std::span<const Point> points, const Point& seen);
  void lower(std::int64_t id, int by);

  MergingSettings settings_;
  std::vector<Missed> missed_;  // non-zero counts only, of landmarks that have twins
};

}  // namespace azimuth
