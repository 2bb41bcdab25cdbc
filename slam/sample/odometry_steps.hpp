#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam/sample/odometry.hpp"

namespace azimuth {

/// A step from one reading to the next that no wheels make: an odometer that began anew, a counter that wrapped, a
/// sender mixed with another one.
struct OdometryJump {
  Stamp stamp{};  ///< of the reading after it
  double step_m = 0.0, step_rad = 0.0;
  double sigma_m = 0.0, sigma_rad = 0.0;  ///< how the robot may have moved meanwhile, which nobody knows
};

/// Judges each step of an odometer by how fast the robot went before it. A step to where odometers begin, at zero, is
/// judged more strictly than others, since hardly any drive ends there by chance.
///
/// Thread contract: thread-bound. Nothing allocates.
class OdometrySteps {
 public:
  /// Nothing: wheels can have made the step, or the odometer says itself that it is none (another origin, a gap).
  std::optional<OdometryJump> next(const OdometryReading& reading);

  /// Jumps are not exceptions but the rule: of another unit, or of two senders. No odometer begins anew so often.
  bool are_frequent() const { return jumps_ > kFew && jumps_ * kOneIn > steps_; }
  std::uint64_t jumps() const { return jumps_; }

 private:
  static constexpr std::uint64_t kFew = 3, kOneIn = 20;

  /// Over a stretch long enough for stamps that jitter.
  struct Speed {
    double m_s = 0.0, rad_s = 0.0;
  };
  Speed usual_speed() const;
  OdometryJump jump(const OdometryReading& reading) const;
  std::optional<OdometryJump> judge(const OdometryReading& reading) const;
  bool goes_to_zero(const OdometryReading& reading, double elapsed_s) const;
  void measure(const OdometryReading& reading, bool is_jump);

  std::optional<OdometryReading> last_;
  double stretch_s_ = 0.0, stretch_m_ = 0.0, stretch_rad_ = 0.0;
  std::array<Speed, 5> speeds_{};  // of the last stretches, which may hold a jump that nobody knew for one
  std::size_t stretches_ = 0;
  double usual_s_ = 0.0;  // between readings
  std::uint64_t steps_ = 0, jumps_ = 0;
};

/// Gives the readings of an odometer that does not say when it begins anew another origin after each jump, and what may
/// have happened meanwhile; those jumps. Leaves all as it is when they are frequent.
std::vector<OdometryJump> part_at_jumps(std::span<OdometryReading> readings);

}  // namespace azimuth
