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

/// Notices landmarks that were mapped twice, where bearings carry no names. A second entry comes about when the first
/// one was predicted badly for a while. Afterwards both claim the same bearings: one is seen and the other is not,
/// although it stands at the same place. Two things that do stand close together are seen both at once sooner or
/// later.
///
/// So each landmark counts the images in which a twin (one of its kind, and near) was seen instead of it, against those
/// in which it was seen itself. What is seen in less than half of them is taken for its twin. Only landmarks whose kind
/// is known have twins: where all are alike, what stands near is as likely to be another one.
///
/// Thread contract: thread-bound. The storage is bounded by the landmarks that have twins.
class Duplicates {
 public:
  explicit Duplicates(const MergingSettings& settings) : settings_(settings) { missed_.reserve(kTypicalLandmarks); }

  /// A landmark that is mapped as a point.
  struct Point {
    std::int64_t id;
    Kind kind;
    Index block;
    std::uint64_t sightings;  ///< so far
    bool seen;                ///< in the present image
  };
  struct Pair {
    std::int64_t keep, drop;  ///< ids; the one seen more often is kept
    bool agree;               ///< what is known of them adds up; else the one dropped was mapped wrongly
  };

  /// The landmarks after an image.
  void observe(const BearingEkf& ekf, std::span<const Point> points);
  /// A pair of points that must be the same, if there is one.
  std::optional<Pair> find(const BearingEkf& ekf, std::span<const Point> points) const;

  /// The landmark is not in the map any more.
  void forget(std::int64_t id) {
    std::erase_if(missed_, [id](const Missed& missed) { return missed.id == id; });
  }

 private:
  struct Missed {
    std::int64_t id;
    int images;  ///< in which a twin was seen instead
  };
  int missed(std::int64_t id) const;
  void raise(std::int64_t id);
  bool are_twins(const BearingEkf& ekf, const Point& a, const Point& b) const;
  const Point* better_twin(const BearingEkf& ekf, std::span<const Point> points, const Point& of) const;
  void count(const BearingEkf& ekf, std::span<const Point> points, const Point& seen);
  void lower(std::int64_t id, int by);

  MergingSettings settings_;
  std::vector<Missed> missed_;  // only of what has a twin, and not 0
};

}  // namespace azimuth
