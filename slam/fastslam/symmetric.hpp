#pragma once
// Symmetric matrices stored as upper triangles: half the memory for a particle's map, and exact symmetry.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace azimuth {

struct Symmetric2 {
  double xx = 0.0, xy = 0.0, yy = 0.0;

  double determinant() const { return xx * yy - xy * xy; }
  Eigen::Matrix2d matrix() const { return Eigen::Matrix2d{{xx, xy}, {xy, yy}}; }
  static Symmetric2 of(const Eigen::Matrix2d& m) { return {m(0, 0), m(0, 1), m(1, 1)}; }
};

inline Symmetric2 operator+(const Symmetric2& a, const Symmetric2& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
}

struct Symmetric3 {
  double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;

  double trace() const { return xx + yy + zz; }
  Eigen::Matrix3d matrix() const { return Eigen::Matrix3d{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}; }
  static Symmetric3 of(const Eigen::Matrix3d& m) { return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)}; }
  /// Adds `factor` * v w^T. The sum of all terms must be symmetric.
  void add(double factor, const Eigen::Vector3d& v, const Eigen::Vector3d& w) {
    xx += factor * v.x() * w.x();
    xy += factor * v.x() * w.y();
    xz += factor * v.x() * w.z();
    yy += factor * v.y() * w.y();
    yz += factor * v.y() * w.z();
    zz += factor * v.z() * w.z();
  }
};

inline Symmetric3 operator+(const Symmetric3& a, const Symmetric3& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}
inline Symmetric3 operator-(const Symmetric3& a, const Symmetric3& b) {
  return {a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yy - b.yy, a.yz - b.yz, a.zz - b.zz};
}

/// A value for each of two correlated measurements, computed together. A GCC vector, since access to halves of an Eigen
/// vector goes through memory.
using Both = double __attribute__((vector_size(16)));

/// Two linear measurements of three quantities: the columns of H, or of H P.
struct TwoRows {
  Both x{}, y{}, z{};

  /// H P
  TwoRows times(const Symmetric3& P) const {
    return {x * P.xx + y * P.xy + z * P.xz, x * P.xy + y * P.yy + z * P.yz, x * P.xz + y * P.yz + z * P.zz};
  }
  Eigen::Matrix<double, 2, 3> matrix() const {
    return Eigen::Matrix<double, 2, 3>{{x[0], y[0], z[0]}, {x[1], y[1], z[1]}};
  }
};
/// H P H^T, from H and H P.
inline Symmetric2 quadratic(const TwoRows& H, const TwoRows& HP) {
  const Both own = H.x * HP.x + H.y * HP.y + H.z * HP.z;
  return {own[0], H.x[1] * HP.x[0] + H.y[1] * HP.y[0] + H.z[1] * HP.z[0], own[1]};
}

/// A Kalman update by two correlated measurements with innovation nu and S = H P H^T + R. Adds K nu to `mean` and
/// subtracts K S K^T from P.
inline void correct(const TwoRows& HP, const Symmetric2& S, const Eigen::Vector2d& nu, Eigen::Vector3d& mean,
                    Symmetric3& P) {
  const double over = 1.0 / S.determinant();
  const auto gain = [&](const Both& by) { return over * (Both{S.yy, S.xx} * by - S.xy * Both{by[1], by[0]}); };
  const Both K_x = gain(HP.x), K_y = gain(HP.y), K_z = gain(HP.z);
  const auto moved = [&](const Both& K) { return K[0] * nu.x() + K[1] * nu.y(); };
  mean += Eigen::Vector3d(moved(K_x), moved(K_y), moved(K_z));
  const auto less = [](double from, const Both& taken) { return from - taken[0] - taken[1]; };
  P = {less(P.xx, K_x * HP.x), less(P.xy, K_x * HP.y), less(P.xz, K_x * HP.z),
       less(P.yy, K_y * HP.y), less(P.yz, K_y * HP.z), less(P.zz, K_z * HP.z)};
}

/// A lower triangular L with L L^T = a, where a may be singular: pivots at the level of rounding errors count as zero.
inline Eigen::Matrix3d semidefinite_factor(const Symmetric3& a) {
  const double least = 1e-12 * std::max({a.xx, a.yy, a.zz, 0.0});
  const auto root = [least](double pivot) { return pivot > least ? std::sqrt(pivot) : 0.0; };
  const auto over = [](double value, double by) { return by > 0.0 ? value / by : 0.0; };
  Eigen::Matrix3d L = Eigen::Matrix3d::Zero();
  L(0, 0) = root(a.xx);
  L(1, 0) = over(a.xy, L(0, 0));
  L(2, 0) = over(a.xz, L(0, 0));
  L(1, 1) = root(a.yy - L(1, 0) * L(1, 0));
  L(2, 1) = over(a.yz - L(2, 0) * L(1, 0), L(1, 1));
  L(2, 2) = root(a.zz - L(2, 0) * L(2, 0) - L(2, 1) * L(2, 1));
  return L;
}

}  // namespace azimuth
