#pragma once
// How a position moves when a correction of the right-invariant error is applied (Barrau & Bonnabel 2017, SE_n(2)):
// q+ = R(turn) q + V(turn) xi, where xi = dq - turn * q_perp is what remains of the linear correction dq when the part
// due to the turn is taken away. A landmark that the correction holds in place (dq = 0) stays exactly in place.

#include <Eigen/Core>
#include <cmath>

namespace azimuth {

inline Eigen::Vector2d perpendicular(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

/// The factors that one turn has in common for all positions.
class InvariantMotion {
 public:
  explicit InvariantMotion(double turn_rad) : turn_(turn_rad), cos_(std::cos(turn_rad)), sin_(std::sin(turn_rad)) {
    const double t = turn_rad, t2 = t * t;
    if (std::abs(t) < 1e-4) {  // series, exact to the last bit here
      along_ = 1.0 - t2 / 6.0;
      across_ = t / 2.0 - t * t2 / 24.0;
      along_by_turn_ = -t / 3.0;
      across_by_turn_ = 0.5 - t2 / 8.0;
    } else {
      along_ = sin_ / t;
      across_ = (1.0 - cos_) / t;
      along_by_turn_ = (cos_ - along_) / t;
      across_by_turn_ = (sin_ - across_) / t;
    }
  }

  /// q+ from q and the linear correction dq.
  Eigen::Vector2d apply(const Eigen::Vector2d& q, const Eigen::Vector2d& dq) const {
    return rotated(q) + V() * (dq - turn_ * perpendicular(q));
  }

  /// d(q+) / d(dq).
  Eigen::Matrix2d V() const {
    Eigen::Matrix2d V;
    V << along_, -across_, across_, along_;
    return V;
  }

  /// d(q+) / d(turn), with dq held.
  Eigen::Vector2d by_turn(const Eigen::Vector2d& q, const Eigen::Vector2d& dq) const {
    Eigen::Matrix2d V_by_turn;
    V_by_turn << along_by_turn_, -across_by_turn_, across_by_turn_, along_by_turn_;
    return perpendicular(rotated(q)) + V_by_turn * (dq - turn_ * perpendicular(q)) - V() * perpendicular(q);
  }

 private:
  Eigen::Vector2d rotated(const Eigen::Vector2d& q) const {
    return {cos_ * q.x() - sin_ * q.y(), sin_ * q.x() + cos_ * q.y()};
  }
  double turn_, cos_, sin_;
  double along_, across_, along_by_turn_, across_by_turn_;  // V = [along -across; across along]
};

}  // namespace azimuth
