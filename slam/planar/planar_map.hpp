#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/ekf/bearing_ekf.hpp"
#include "slam/estimator/landmark_book.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/planar/candidates.hpp"
#include "slam/planar/duplicates.hpp"
#include "slam/planar/ekf_choices.hpp"
#include "slam/planar/ekf_settings.hpp"
#include "slam/planar/planar_landmark.hpp"

namespace azimuth {

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
