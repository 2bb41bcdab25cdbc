#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam/ceiling/ceiling_view.hpp"
#include "slam/ceiling/lamp_ekf_settings.hpp"
#include "slam/ekf/lamp_ekf.hpp"
#include "slam/estimator/landmark_book.hpp"
#include "slam/estimator/restartable_estimator.hpp"
#include "slam/fastslam/lamp_evidence.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

struct LampMatches;

/// What the lamp EKF knows of a lamp in addition to its state.
struct Lamp {
  std::int64_t id = 0;
  Identity identity = kUnknownIdentity;
  LampBlock at;
  std::uint64_t sightings = 0;  ///< Number of detections used
  double log_odds = 0.0;        ///< Log odds of the lamp's existence, from detections and misses
  LampEvidence evidence;        ///< Evidence for a lamp against chance reflections
  int missed_in_row = 0;        ///< Consecutive misses in the field of view since the last detection
  double first_seen_m = 0.0;    ///< Path driven at the first detection
  double last_seen_m = 0.0;
  std::uint64_t last_image = 0;    ///< Number of the last image that detected the lamp
  std::uint64_t last_weighed = 0;  ///< Number of the last image whose detection was weighed as evidence
  bool confirmed = false;          ///< Whether the lamp has passed probation
};

/// The lamps of the lamp EKF: their initialisation, confirmation, merging and deletion.
///
/// Thread contract: thread-bound.
class LampMap {
 public:
  /// If `usual` is empty, new lamps are linearised about the height guess of the settings.
  LampMap(const LampEkfSettings& settings, const CeilingView& view, const std::optional<UsualHeight>& usual = {});

  std::span<const Lamp> lamps() const { return book_.entries(); }
  const Lamp& operator[](std::size_t at) const { return book_[at]; }
  bool empty() const { return book_.empty(); }
  std::size_t confirmed() const;
  /// Heights above the camera of the confirmed lamps; nullopt if there are none.
  std::optional<UsualHeight> usual_height(const LampEkf& ekf) const;
  bool any_proven() const;
  std::int64_t next_id() const { return book_.next_id(); }
  void continue_from(std::int64_t next_id) { book_.continue_from(next_id); }
  std::uint64_t created() const { return created_; }  ///< Confirmed lamps; those on probation are not published
  std::uint64_t deleted() const { return deleted_; }

  /// Restores the lamps of a saved map, whose states are in `blocks` of the filter.
  void restore(const MapSnapshot& map, std::span<const Index> blocks);

  /// Begins the next image, taken after `path_m` of driving.
  void begin_image(double path_m) {
    ++image_;
    path_m_ = path_m;
  }
  /// Weighs the evidence for each unproven lamp by its predicted direction, before the image updates the filter.
  void weigh_evidence(LampEkf& ekf, const CeilingImage& image, const LampMatches& matches);
  /// Records that the image detected the lamp at index `at`.
  void was_seen(std::size_t at);
  /// Records pairs of nearby lamps that one image shows as two.
  void note_apart(const LampMatches& matches);
  /// Counts the lamps that the image should show and does not.
  void count_misses(const LampMatches& matches);
  /// Ignores misses up to now, because the pose was wrong.
  void hold_judgement() { last_judged_m_ = path_m_; }
  /// Merges duplicates and deletes lamps that are clutter, switched off or not above the camera.
  void tidy(LampEkf& ekf);
  /// Initialises lamps from directions that match no lamp, as far as there is room.
  void add(LampEkf& ekf, const CeilingImage& image, const LampMatches& matches);
  /// Converts lamps with a known height to points, and confirms proven lamps. Returns whether any lamp was confirmed.
  bool promote_converged(LampEkf& ekf);

 private:
  /// Two nearby lamps that one image showed as two.
  struct Apart {
    std::int64_t a, b;
  };
  void merge_twins(LampEkf& ekf);
  void forget_doubtful(LampEkf& ekf);
  std::optional<std::size_t> twin_of(const Lamp& missed, const LampEkf& ekf) const;
  bool are_apart(std::int64_t a, std::int64_t b) const;
  void begin_lamp(LampEkf& ekf, const CeilingImage& image, std::size_t direction);
  bool is_to_be_confirmed(const Lamp& lamp, double nonlinearity) const;
  void forget(std::size_t at);

  LampEkfSettings settings_;
  CeilingView view_;
  double log_seen_;  // Log-likelihood ratio of one detection
  double inverse_height_per_m_, sigma_inverse_height_per_m_;
  LandmarkBook<Lamp> book_;
  std::vector<Apart> apart_;
  std::uint64_t created_ = 0, deleted_ = 0;
  std::uint64_t image_ = 0;
  double path_m_ = 0.0, last_judged_m_ = 0.0, last_weighed_m_ = 0.0;
};

}  // namespace azimuth
