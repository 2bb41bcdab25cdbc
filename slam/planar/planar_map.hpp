#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam/ekf/bearing_ekf.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/estimator/landmark_book.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/planar/candidates.hpp"
#include "slam/planar/ekf_choices.hpp"
#include "slam/planar/ekf_settings.hpp"
#include "slam/planar/planar_landmark.hpp"
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

/// The planar filter's landmarks: initialisation, probation, merging of duplicates, and removal.
///
/// Thread contract: thread-bound.
class PlanarMap {
 public:
  PlanarMap(const Rig& rig, const EkfSettings& settings, Initialisation initialisation);

  std::span<const PlanarLandmark> landmarks() const { return book_.entries(); }
  std::size_t size() const { return book_.size(); }
  bool empty() const { return book_.empty(); }
  PlanarLandmark& operator[](std::size_t at) { return book_[at]; }
  const PlanarLandmark& operator[](std::size_t at) const { return book_[at]; }
  std::int64_t next_id() const { return book_.next_id(); }
  void continue_from(std::int64_t next_id) { book_.continue_from(next_id); }
  std::uint64_t created() const { return created_; }  ///< Confirmed landmarks only, since others are not published
  std::uint64_t deleted() const { return deleted_; }
  const Candidates& candidates() const { return candidates_; }

  /// Takes over a saved map's landmarks, which are in the filter's `blocks`.
  void restore(const MapSnapshot& map, std::span<const Index> blocks);
  /// Empties the map, counts included.
  void forget_everything(BearingEkf& ekf);

  /// Time and path length at which an image was taken.
  struct Instant {
    Stamp stamp;
    double path_m;  ///< Distance driven by then
  };
  /// Maintenance after an image, where landmarks have no names: confirms landmarks seen often enough, merges duplicates
  /// and removes clutter.
  void tidy(BearingEkf& ekf, const Instant& now);
  /// Initialises landmarks from bearings of unmapped landmarks, or stores the bearings until that is possible, as long
  /// as there is room. Returns true when there are new landmarks.
  bool add(BearingEkf& ekf, std::span<const Bearing> unmapped, const Instant& now);
  /// Converts inverse-depth landmarks to points where a point describes them as well.
  void promote_converged(BearingEkf& ekf);

  /// Removes landmarks that were rejected this many times in a row. Returns their number.
  std::size_t remove_contradicted(BearingEkf& ekf, int rejected_in_row);

 private:
  bool has_names() const { return names_landmarks(rig_); }
  /// Named landmarks are no clutter. Ready-made bearings count as checked by their source.
  bool starts_confirmed() const { return has_names() || rig_.front_end == FrontEnd::bearings; }
  bool is_seen_often(const PlanarLandmark& landmark) const;
  void confirm();
  void merge_duplicates(BearingEkf& ekf, Stamp stamp);
  void merge(BearingEkf& ekf, const Duplicates::Pair& pair);
  void list_points(Stamp stamp);
  void drop_on_probation(BearingEkf& ekf, double path_m);
  void add_rays(BearingEkf& ekf, std::span<const Bearing> unmapped, const Instant& now);
  void add(PlanarLandmark landmark, std::uint64_t sightings, double radius_px, const Instant& now);
  void remove(BearingEkf& ekf, std::size_t at);
  void forget(std::size_t at);

  Rig rig_;
  EkfSettings settings_;
  Initialisation initialisation_;
  LandmarkBook<PlanarLandmark> book_;
  Candidates candidates_;
  Duplicates duplicates_;
  std::uint64_t created_ = 0, deleted_ = 0;
  std::vector<Duplicates::Point> points_;  ///< Points in the running image
};

}  // namespace azimuth
