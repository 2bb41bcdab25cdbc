#pragma once
// Effect of a correction of the right-invariant error on a position (Barrau & Bonnabel 2017, SE_n(2)): the exponential
// of (turn, xi) maps q to R(turn) q + V(turn) xi, where xi = dq - turn * q_perp is the linear correction dq without the
// part due to the turn. Since R(turn) q - turn V q_perp = q, this is
//
//   q+ = q + V(turn) dq,   V = [sin t, -(1 - cos t); 1 - cos t, sin t] / t
//
// A landmark that the correction keeps in place (dq = 0) stays in place, and a turn of the whole map stays a turn.

#include <Eigen/Core>
#include <cmath>

namespace azimuth {

inline Eigen::Vector2d perpendicular(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

/// The factors of one turn, the same for all positions.
class InvariantMotion {
 public:
  explicit InvariantMotion(double turn_rad) {
    const double half = 0.5 * turn_rad, s = std::sin(half);
    if (std::abs(turn_rad) < 1e-6) {  // exact to the last bit for such small turns
      along_ = 1.0;
      across_ = half;
    } else {
      along_ = std::sin(turn_rad) / turn_rad;
      across_ = 2.0 * s * s / turn_rad;
    }
  }

  /// Computes q+ from q and the linear correction dq.
  Eigen::Vector2d apply(const Eigen::Vector2d& q, const Eigen::Vector2d& dq) const {
    return {q.x() + along_ * dq.x() - across_ * dq.y(), q.y() + across_ * dq.x() + along_ * dq.y()};
  }

 private:
  double along_, across_;  // V = [along -across; across along]
};

}  // namespace azimuth
