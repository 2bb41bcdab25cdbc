#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam/ceiling/ceiling_view.hpp"
#include "slam/ceiling/lamp_ekf_settings.hpp"
#include "slam/ekf/lamp_ekf.hpp"
#include "slam/estimator/begins_twice.hpp"
#include "slam/estimator/landmark_book.hpp"
#include "slam/fastslam/lamp_evidence.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

struct LampMatches;

/// What the lamp EKF knows of a lamp beside its state.
struct Lamp {
  std::int64_t id = 0;
  Identity identity = kUnknownIdentity;
  LampBlock at;
  std::uint64_t sightings = 0;  ///< that were used
  double log_odds = 0.0;        ///< of being there, by sightings and misses
  LampEvidence evidence;        ///< of being a lamp, and not what reflections look like by chance
  int missed_in_row = 0;        ///< since the last sighting, where it should have been seen
  double first_seen_m = 0.0;    ///< path driven by then
  double last_seen_m = 0.0;
  std::uint64_t last_image = 0;    ///< in which it was seen
  std::uint64_t last_weighed = 0;  ///< image of its last evidence by a sighting
  bool confirmed = false;          ///< no longer on probation
};

/// The lamp EKF's lamps: how they come into its state, prove to be lamps, are told from each other, and go.
///
/// Thread contract: thread-bound.
class LampMap {
 public:
  /// Without `usual` new lamps are linearised about the settings' guess.
  LampMap(const LampEkfSettings& settings, const CeilingView& view, const std::optional<UsualHeight>& usual = {});

  std::span<const Lamp> lamps() const { return book_.entries(); }
  const Lamp& operator[](std::size_t at) const { return book_[at]; }
  bool empty() const { return book_.empty(); }
  std::size_t confirmed() const;
  /// Above the camera, of the confirmed ones; nothing while there are none.
  std::optional<UsualHeight> usual_height(const LampEkf& ekf) const;
  bool any_proven() const;
  std::int64_t next_id() const { return book_.next_id(); }
  void continue_from(std::int64_t next_id) { book_.continue_from(next_id); }
  std::uint64_t created() const { return created_; }  ///< confirmed, rather: nobody hears of the others
  std::uint64_t deleted() const { return deleted_; }

  /// Takes over a saved map's lamps, which stand in the filter's `blocks`.
  void restore(const MapSnapshot& map, std::span<const Index> blocks);

  /// The next image, seen after `path_m` of driving.
  void begin_image(double path_m) {
    ++image_;
    path_m_ = path_m;
  }
  /// Of what may be no lamp, by what was predicted before anything is learnt from the image.
  void weigh_evidence(LampEkf& ekf, const CeilingImage& image, const LampMatches& matches);
  /// The image shows the lamp.
  void was_seen(std::size_t at);
  /// Two lamps that the image shows near each other are two.
  void note_apart(const LampMatches& matches);
  /// What the image should show and does not.
  void count_misses(const LampMatches& matches);
  /// What was missed until now says nothing: the pose was wrong.
  void hold_judgement() { last_judged_m_ = path_m_; }
  /// Twins become one; clutter, what was switched off, and what is not above the camera after all, go.
  void tidy(LampEkf& ekf);
  /// Begins lamps of what is of no other, as far as there is room.
  void add(LampEkf& ekf, const CeilingImage& image, const LampMatches& matches);
  /// Those whose height is known become points, and those beyond doubt are confirmed. True: some were.
  bool promote_converged(LampEkf& ekf);

 private:
  /// Two lamps that were seen in one image, near each other.
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
  double log_seen_;  // what a sighting is worth
  double inverse_height_per_m_, sigma_inverse_height_per_m_;
  LandmarkBook<Lamp> book_;
  std::vector<Apart> apart_;
  std::uint64_t created_ = 0, deleted_ = 0;
  std::uint64_t image_ = 0;
  double path_m_ = 0.0, last_judged_m_ = 0.0, last_weighed_m_ = 0.0;
};

}  // namespace azimuth
