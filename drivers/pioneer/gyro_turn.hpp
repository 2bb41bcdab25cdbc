#pragma once
#include <optional>

#include "drivers/pioneer/motion_packets.hpp"

namespace azimuth::pioneer {

/// The turn measured by the analog gyro. The gyro's rate at rest is learned while the robot stands still.
///
/// Thread contract: thread-bound; never allocates.
class GyroTurn {
 public:
  /// `scale` is RobotParameters::gyro_scale.
  explicit GyroTurn(double scale);

  void add(const GyroPacket& packet);
  /// Tells whether the wheels stood still over the last `elapsed_s`, the time of the samples since the last note.
  void note_standing(bool standing, double elapsed_s);

  /// The counter-clockwise turn since the last take. None while the rate at rest is unknown, or when samples are
  /// missing in the `elapsed_s` since then.
  std::optional<double> take_rad(double elapsed_s);

 private:
  double rad_per_count_;
  double sum_ = 0.0;  // sum of the rates since the last take
  int count_ = 0;
  double rest_sum_ = 0.0, rest_s_ = 0.0;  // sum of the rates at rest, and its time
  int rest_count_ = 0;
  double new_sum_ = 0.0;  // sum of the rates since the last note
  int new_count_ = 0;
  std::optional<double> rate_at_rest_;
};

/// Combines the turns measured by wheels and gyro, weighted by their inverse variances.
struct FusedTurn {
  double turn_rad = 0.0;
  bool skid = false;  ///< the gyro turned but the wheels did not: the gyro is used
};
FusedTurn fuse_turns(double wheels_rad, double gyro_rad, double elapsed_s);

}  // namespace azimuth::pioneer
