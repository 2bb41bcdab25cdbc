#pragma once
#include <algorithm>
#include <bit>
#include <complex>
#include <cstdint>
#include <optional>

#include "slam/estimator/rig.hpp"
#include "slam/sample/odometry.hpp"
#include "slam/sample/odometry_steps.hpp"

namespace azimuth {

/// How often a condition held in its last 64 evaluations. Thread contract: thread-bound.
class Recent {
 public:
  void add(bool held) {
    bits_ = bits_ << 1U | (held ? 1U : 0U);
    asked_ = std::min(asked_ + 1, 64);
  }
  int asked() const { return asked_; }
  int held() const { return std::popcount(bits_); }
  bool mostly() const { return 2 * held() > asked_; }

 private:
  std::uint64_t bits_ = 0;
  int asked_ = 0;
};

/// A fault found in wheel odometry.
enum class OdometryDoubt : std::uint8_t {
  none,
  too_quick,           ///< Speed and turn rate are both impossible: the stamps run too slowly
  too_fast,            ///< Speed is impossible, turn rate is not
  heading_in_degrees,  ///< The turn rate is impossible, or motion follows only a heading read as degrees
  jumps                ///< Repeated steps that wheels cannot make
};

/// Judges odometry, calibrated by the rig, in windows of half a second in which the robot moved.
///
/// Thread contract: thread-bound. Nothing allocates.
class OdometryWatch {
 public:
  explicit OdometryWatch(const OdometryRig& rig) : rig_(rig) {}

  void add(const OdometryReading& reading);

  /// The fault found so far. `few`: no more readings will come, so that a few windows must be enough.
  OdometryDoubt doubt(bool few) const;
  double fastest_m_s() const { return fastest_m_s_; }
  double fastest_rad_s() const { return fastest_rad_s_; }
  std::uint64_t jumps() const { return steps_.jumps(); }
  const OdometryJump& largest_jump() const { return largest_jump_; }

 private:
  struct Window {
    OdometryReading start, last;
    // unwrapped, since degrees taken for radians exceed a full turn
    double heading_at_start_rad = 0.0, heading_rad = 0.0;
    double turned_rad = 0.0;  // sum of the turns' magnitudes
  };
  void judge(const Window& window);
  void judge_direction(double direction_rad, double heading_rad);
  bool fits_degrees() const;

  OdometryRig rig_;
  OdometrySteps steps_;
  OdometryJump largest_jump_;
  std::optional<Window> window_;
  Recent driven_too_fast_, turned_too_fast_;
  double fastest_m_s_ = 0.0, fastest_rad_s_ = 0.0;
  // Sums of unit vectors at doubled angles, so that driving backwards counts as forwards; recent windows weigh most.
  std::complex<double> directions_, off_heading_, off_heading_in_degrees_;
  double directions_count_ = 0.0;
  int moves_ = 0;
};

}  // namespace azimuth
