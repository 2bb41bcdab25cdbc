#pragma once
#include <cstdint>
#include <string_view>

#include "slam/estimator/odometry_watch.hpp"
#include "slam/estimator/recent.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/estimator/rig_finding.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// What keeps samples from being of use, however good an estimator is: units, clocks, a rig that says otherwise. What
/// hides what comes below stands first.
enum class SampleTrouble : std::uint8_t {
  none,
  odometry_too_quick,           ///< drives and turns impossibly fast: stamps in another unit
  odometry_too_fast,            ///< impossibly fast: millimetres
  odometry_heading_in_degrees,  ///< turns impossibly fast, or drives along its heading only in degrees
  odometry_jumps,               ///< again and again a step that no wheels make
  bearings_in_degrees,          ///< angles beyond a full turn
  no_odometry,                  ///< not one reading
  one_reading,                  ///< but no motion without a second one
  apart_in_time,                ///< of other times than the odometry, but for a tenth at most
  odometry_too_rare,            ///< readings farther apart than may be interpolated
  odometry_missing,             ///< for most sets, why ever
  images_of_no_use,             ///< every one of them
  nothing_seen,                 ///< not one bearing
  no_identities,                ///< which the rig promises, so that nothing can be told apart
  names_repeated,               ///< in most images: several in one
  rig_contradicted,             ///< a value of the rig is not what the drive shows
  bearings_scatter,             ///< far more than the rig says
  odometry_scatters             ///< likewise
};

/// In a few words; empty for none. Static text.
std::string_view to_string(SampleTrouble trouble);

/// From the first to the last stamp.
struct StampSpan {
  Stamp first{}, last{};
  std::uint64_t count = 0;

  void add(Stamp stamp);
  double seconds() const { return to_seconds(last - first); }
};

/// A trouble and the numbers that belong to it, for a sentence about it (settings/sample_sentence.hpp).
struct SampleFinding {
  SampleTrouble trouble = SampleTrouble::none;
  StampSpan odometry, sets;                 ///< that came in order
  std::uint64_t bearings = 0;               ///< in those sets
  std::uint64_t without_odometry = 0;       ///< sets that were refused for it
  double wait_limit_s = 0.0;                ///< for a reading that belongs to a set
  double fastest_m_s = 0.0;                 ///< odometry, calibrated
  double fastest_rad_s = 0.0;               ///< likewise
  std::uint64_t jumps = 0;                  ///< steps of the odometry that no wheels make
  OdometryJump largest_jump;                ///< of those
  double largest_angle_rad = 0.0;           ///< of a bearing
  std::uint64_t repeating = 0;              ///< sets with a landmark more than once
  ImageTrouble image = ImageTrouble::none;  ///< of the last set
  double sigma_bearing_rad = 0.0;           ///< as the rig says
  RigFinding rig;                           ///< by the estimator
};

/// Judges whether samples can be what the rig says they are, as they come: for daemon and replay alike. It takes
/// several to be sure; what came right again is no trouble any more.
///
/// Thread contract: thread-bound. Nothing allocates.
class SampleWatch {
 public:
  SampleWatch(const Rig& rig, Duration wait_limit);

  void add(const OdometryReading& reading);
  void add(const BearingSet& set);
  void used() { refused_.add(false); }  ///< a set, in a step
  void refused() {
    refused_.add(true);
    ++finding_.without_odometry;
  }                                                          ///< a set, for want of odometry
  void found(const RigFinding& rig) { finding_.rig = rig; }  ///< by the estimator, so far
  void finish() { finished_ = true; }                        ///< no more will come: what there is has to do

  SampleTrouble trouble() const;
  /// What makes any pose wrong: samples in other units. none: nothing.
  SampleTrouble impossible() const;
  /// With the numbers so far.
  SampleFinding finding() const;

 private:
  SampleTrouble odometry_trouble() const;
  SampleTrouble time_trouble() const;
  SampleTrouble bearing_trouble() const;
  SampleTrouble rig_trouble() const;
  bool enough(std::uint64_t count, std::uint64_t wanted) const { return count >= (finished_ ? 1 : wanted); }

  bool promises_identities_;
  Duration wait_limit_;
  OdometryWatch odometry_;
  Recent refused_;
  SampleFinding finding_;
  std::uint64_t named_ = 0, beyond_ = 0, troubled_ = 0, unreadable_ = 0;
  bool finished_ = false;
};

/// An angle that no radians come to: beyond a full turn, or an elevation beyond the vertical.
bool is_beyond_radians(const Bearing& bearing);

}  // namespace azimuth
