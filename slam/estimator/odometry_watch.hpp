#pragma once
#include <complex>
#include <cstdint>
#include <optional>

#include "slam/estimator/recent.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/sample/odometry.hpp"
#include "slam/sample/odometry_steps.hpp"

namespace azimuth {

/// What cannot be right about odometry of wheels.
enum class OdometryDoubt : std::uint8_t {
  none,
  too_quick,           ///< drives and turns faster than any robot: its stamps run too slowly
  too_fast,            ///< drives so, but turns as it may
  heading_in_degrees,  ///< turns so, or drives along its heading only if that is read as degrees
  jumps                ///< steps that no wheels make, again and again
};

/// Judges odometry, calibrated by the rig, in windows of half a second in which it moved.
///
/// Thread contract: thread-bound. Nothing allocates.
class OdometryWatch {
 public:
  explicit OdometryWatch(const OdometryRig& rig) : rig_(rig) {}

  void add(const OdometryReading& reading);

  /// `few`: no more will come, so that a few windows have to do.
  OdometryDoubt doubt(bool few) const;
  double fastest_m_s() const { return fastest_m_s_; }
  double fastest_rad_s() const { return fastest_rad_s_; }
  std::uint64_t jumps() const { return steps_.jumps(); }
  const OdometryJump& largest_jump() const { return largest_jump_; }

 private:
  struct Window {
    OdometryReading start, last;
    double heading_at_start_rad = 0.0, heading_rad = 0.0;  // unwrapped: degrees taken for radians go round and round
    double turned_rad = 0.0;                               // to either side
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
  // Doubled angles as unit vectors, so that backwards is as good as forwards; recent ones count most.
  std::complex<double> directions_, off_heading_, off_heading_in_degrees_;
  double directions_count_ = 0.0;
  int moves_ = 0;
};

}  // namespace azimuth
