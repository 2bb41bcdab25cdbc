#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam/sample/odometry.hpp"

namespace azimuth {

/// A step between two readings that wheels cannot have made: the odometer restarted, a counter wrapped, or two senders
/// are mixed.
struct OdometryJump {
  Stamp stamp{};  ///< stamp of the reading after the step
  double step_m = 0.0, step_rad = 0.0;
  double sigma_m = 0.0, sigma_rad = 0.0;  ///< standard deviations of the robot's unknown motion during the step
};

/// Detects jumps of an odometer by the robot's speed before each step. A step to zero, where odometers start, is judged
/// more strictly, since hardly any drive ends at zero by chance.
///
/// Thread contract: thread-bound. Does not allocate.
class OdometrySteps {
 public:
  /// Returns the jump from the previous reading to this one, if any. Returns nothing if wheels can have made the step
  /// or if the odometer itself reports a new origin or a gap.
  std::optional<OdometryJump> next(const OdometryReading& reading);

  /// Whether jumps are too frequent to be restarts. The readings are then in another unit or from two senders.
  bool are_frequent() const { return jumps_ > kFew && jumps_ * kOneIn > steps_; }
  std::uint64_t jumps() const { return jumps_; }

 private:
  static constexpr std::uint64_t kFew = 3, kOneIn = 20;

  /// Speed over a stretch that is long compared with the jitter of stamps.
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
  std::array<Speed, 5> speeds_{};  // of the last stretches; some may contain an undetected jump
  std::size_t stretches_ = 0;
  double usual_s_ = 0.0;  // usual interval between readings
  std::uint64_t steps_ = 0, jumps_ = 0;
};

/// For an odometer that does not report its restarts: sets a new origin and the uncertainty of the unknown motion in
/// the readings after each jump. Returns the jumps. Changes nothing and returns no jumps when they are frequent.
std::vector<OdometryJump> part_at_jumps(std::span<OdometryReading> readings);

}  // namespace azimuth
