#pragma once
#include <optional>

#include "drivers/pioneer/motion_packets.hpp"

namespace azimuth::pioneer {

/// The turn that the analog gyro measures. Its rate at rest is learned while the robot stands.
///
/// Thread contract: thread-bound; never allocates.
class GyroTurn {
 public:
  /// `scale`: RobotParameters::gyro_scale.
  explicit GyroTurn(double scale);

  void add(const GyroPacket& packet);
  /// Whether the wheels stood over the last `elapsed_s`, to which the samples since the last note belong.
  void note_standing(bool standing, double elapsed_s);

  /// The turn (counter-clockwise) since the last take. Nothing while the rate at rest is not known, or when samples
  /// are missing in the `elapsed_s` since then.
  std::optional<double> take_rad(double elapsed_s);

 private:
  double rad_per_count_;
  double sum_ = 0.0;  // of rates since the last take
  int count_ = 0;
  double rest_sum_ = 0.0, rest_s_ = 0.0;  // while standing
  int rest_count_ = 0;
  double new_sum_ = 0.0;  // since the last note
  int new_count_ = 0;
  std::optional<double> rate_at_rest_;
};

/// The turn from that of the wheels and that of the gyro, each weighted by its variance.
struct FusedTurn {
  double turn_rad = 0.0;
  bool skid = false;  ///< the gyro turned and the wheels do not know of it: the gyro is right
};
FusedTurn fuse_turns(double wheels_rad, double gyro_rad, double elapsed_s);

}  // namespace azimuth::pioneer
