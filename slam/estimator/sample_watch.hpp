#pragma once
#include <cstdint>
#include <string_view>

#include "slam/estimator/odometry_watch.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// Why samples are useless to any estimator: wrong units, clocks or rig. A trouble that hides later ones comes first.
enum class SampleTrouble : std::uint8_t {
  none,
  odometry_too_quick,           ///< Impossibly fast driving and turning: stamps in another unit
  odometry_too_fast,            ///< Impossibly fast driving: millimetres taken for metres
  odometry_heading_in_degrees,  ///< Impossibly fast turning, or motion that follows the heading only if read as degrees
  odometry_jumps,               ///< Repeated steps that wheels cannot make
  bearings_in_degrees,          ///< Angles beyond a full turn
  no_odometry,                  ///< No reading at all
  one_reading,                  ///< One reading only, hence no motion
  apart_in_time,                ///< Bearings and odometry overlap in time by a tenth at most
  odometry_too_rare,            ///< Readings farther apart than may be interpolated
  odometry_missing,             ///< No odometry for most sets, for another reason
  images_of_no_use,             ///< Every image is useless
  nothing_seen,                 ///< No bearing at all
  no_identities,                ///< Bearings lack the identities that the rig promises: landmarks cannot be told apart
  names_repeated,               ///< A landmark occurs more than once in most images
  rig_contradicted,             ///< A value of the rig differs from what the drive shows
  bearings_scatter,             ///< Bearings are far noisier than the rig says
  odometry_scatters             ///< Odometry is far noisier than the rig says
};

/// A short description; empty for `none`. Static text.
std::string_view to_string(SampleTrouble trouble);

/// First and last stamp of a series of samples, and their number.
struct StampSpan {
  Stamp first{}, last{};
  std::uint64_t count = 0;

  void add(Stamp stamp);
  double seconds() const { return to_seconds(last - first); }
};

/// A trouble and the numbers needed to describe it (settings/sample_sentence.hpp).
struct SampleFinding {
  SampleTrouble trouble = SampleTrouble::none;
  StampSpan odometry, sets;                 ///< Samples that came in order
  std::uint64_t bearings = 0;               ///< Number of bearings in those sets
  std::uint64_t without_odometry = 0;       ///< Sets refused for lack of odometry
  double wait_limit_s = 0.0;                ///< Wait limit for the odometry of a set
  double fastest_m_s = 0.0;                 ///< Fastest speed of the calibrated odometry
  double fastest_rad_s = 0.0;               ///< Fastest turn rate of the calibrated odometry
  std::uint64_t jumps = 0;                  ///< Odometry steps that wheels cannot make
  OdometryJump largest_jump;                ///< The largest of those steps
  double largest_angle_rad = 0.0;           ///< Largest angle of a bearing that cannot be in radians
  std::uint64_t repeating = 0;              ///< Sets with a landmark more than once
  ImageTrouble image = ImageTrouble::none;  ///< Trouble of the last set
  double sigma_bearing_rad = 0.0;           ///< The rig's standard deviation of a bearing
  RigFinding rig;                           ///< What the estimator has found out about the rig
};

/// Judges, as samples arrive, whether they can be what the rig says they are; used by daemon and replay alike. A
/// trouble is reported once several samples show it, and disappears when later samples are right.
///
/// Thread contract: thread-bound. Nothing allocates.
class SampleWatch {
 public:
  SampleWatch(const Rig& rig, Duration wait_limit);

  void add(const OdometryReading& reading);
  void add(const BearingSet& set);
  void used() { refused_.add(false); }  ///< A set was used in a step
  void refused() {
    refused_.add(true);
    ++finding_.without_odometry;
  }                                                          ///< A set was refused for lack of odometry
  void found(const RigFinding& rig) { finding_.rig = rig; }  ///< The estimator's present findings about the rig
  void finish() { finished_ = true; }                        ///< No more samples will come: judge by those at hand

  SampleTrouble trouble() const;
  /// The trouble that makes every pose wrong: samples in other units. `none` if there is no such trouble.
  SampleTrouble impossible() const;
  /// The present trouble with the numbers so far.
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

/// Whether an angle cannot be in radians: an azimuth beyond a full turn, or an elevation beyond the vertical.
bool is_beyond_radians(const Bearing& bearing);

}  // namespace azimuth
