#include "slam/map_merge/joint_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace azimuth {
namespace {

constexpr int kMostTurns = 20;
constexpr double kConverged = 1e-10;  // In metres and radians

/// The constraint of all pairs, linearised at the fit's means: gap + H x + G T, equation (2) of docs/mathematics.md,
/// VI.30.
class Constraint {
 public:
  Constraint(const MapGaussian& a, const MapGaussian& b, JointFit& fit) : a_(a), b_(b), fit_(fit) {
    for (const Correspondence& pair : fit.pairs) {
      fit.row_of.push_back(fit.rows);
      fit.rows += rows_of_pair(a, b, pair);
    }
    for (const Correspondence& pair : fit.pairs)
      for (Eigen::Index k = 0; k < rows_of_pair(a, b, pair); ++k) {
        rows_a_.push_back(a.row[pair.a] + k);
        rows_b_.push_back(b.row[pair.b] + k);
      }
    P_a_ = a.covariance(rows_a_, rows_a_);
    P_b_ = b.covariance(rows_b_, rows_b_);
  }

  /// Returns false if the constraint does not determine T.
  bool linearise() {
    R_ = Eigen::MatrixXd::Identity(fit_.rows, fit_.rows);
    G_ = Eigen::MatrixXd::Zero(fit_.rows, 3);
    gap_.resize(fit_.rows);
    for (std::size_t i = 0; i < fit_.pairs.size(); ++i) set_rows(fit_.pairs[i], fit_.row_of[i]);
    // Equation (3) of docs/mathematics.md, VI.30: the gap at the maps' own means, and its covariance.
    gap_ += (a_.mean - fit_.mean_a)(rows_a_)-R_ * (b_.mean - fit_.mean_b)(rows_b_);
    S_.compute(P_a_ + R_ * P_b_ * R_.transpose());
    if (S_.info() != Eigen::Success) return false;
    fit_.S_inverse_G = S_.solve(G_);
    const Eigen::LLT<Eigen::Matrix3d> information(G_.transpose() * fit_.S_inverse_G);
    if (information.info() != Eigen::Success) return false;
    fit_.covariance_T = information.solve(Eigen::Matrix3d::Identity());
    return fit_.covariance_T.allFinite();
  }

  /// Moves the fit's means by one step and returns the greatest change.
  double step() {
    const Eigen::Vector3d change = -fit_.covariance_T * (fit_.S_inverse_G.transpose() * gap_);
    gap_ += G_ * change;
    fit_.weighted_gap = S_.solve(gap_);
    fit_.T_a_b = {fit_.T_a_b.x_m + change.x(), fit_.T_a_b.y_m + change.y(), wrap(fit_.T_a_b.heading_rad + change.z())};
    const Eigen::VectorXd mean_a = a_.mean - a_.covariance(Eigen::all, rows_a_) * fit_.weighted_gap;
    const Eigen::VectorXd mean_b = b_.mean + b_.covariance(Eigen::all, rows_b_) * (R_.transpose() * fit_.weighted_gap);
    const double moved = std::max({change.cwiseAbs().maxCoeff(), (mean_a - fit_.mean_a).cwiseAbs().maxCoeff(),
                                   (mean_b - fit_.mean_b).cwiseAbs().maxCoeff()});
    fit_.mean_a = mean_a;
    fit_.mean_b = mean_b;
    return moved;
  }

  /// Equations (4) to (7) of docs/mathematics.md, VI.30.
  void finish() {
    fit_.chi2 = gap_.dot(fit_.weighted_gap);
    fit_.U_a = a_.covariance(Eigen::all, rows_a_);
    fit_.U_b = -b_.covariance(Eigen::all, rows_b_) * R_.transpose();
    fit_.Q = S_.solve(Eigen::MatrixXd::Identity(fit_.rows, fit_.rows)) -
             fit_.S_inverse_G * fit_.covariance_T * fit_.S_inverse_G.transpose();
    double log_det_S = 0.0;
    for (Eigen::Index i = 0; i < fit_.rows; ++i) log_det_S += 2.0 * std::log(S_.matrixLLT()(i, i));
    fit_.log_evidence = -0.5 * fit_.chi2 - 0.5 * log_det_S + 0.5 * std::log(fit_.covariance_T.determinant()) -
                        0.5 * static_cast<double>(fit_.rows - 3) * std::log(2.0 * std::numbers::pi);
    fit_.sound = std::isfinite(fit_.log_evidence);
  }

 private:
  void set_rows(const Correspondence& pair, Eigen::Index row) {
    const Eigen::Index row_a = a_.row[pair.a], row_b = b_.row[pair.b];
    const Gap between = gap(fit_.mean_a.segment<2>(row_a), fit_.T_a_b, fit_.mean_b.segment<2>(row_b));
    gap_.segment<2>(row) = between.value_m;
    R_.block<2, 2>(row, row) = -between.by_p_b;
    G_.block<2, 3>(row, 0) = between.by_T;
    if (rows_of_pair(a_, b_, pair) == 3) gap_(row + 2) = fit_.mean_a(row_a + 2) - fit_.mean_b(row_b + 2);
  }

  const MapGaussian &a_, &b_;
  JointFit& fit_;
  std::vector<Eigen::Index> rows_a_, rows_b_;
  Eigen::MatrixXd P_a_, P_b_, R_, G_;
  Eigen::VectorXd gap_;
  Eigen::LLT<Eigen::MatrixXd> S_;
};

}  // namespace

Gap gap(const Eigen::Vector2d& p_a, const Pose2& T_a_b, const Eigen::Vector2d& p_b) {
  const Eigen::Matrix2d R = rotation(T_a_b.heading_rad);
  const Eigen::Vector2d turned = R * p_b;
  Gap between{p_a - T_a_b * p_b, -R, {}};
  between.by_T << -1.0, 0.0, turned.y(), 0.0, -1.0, -turned.x();
  return between;
}

Eigen::Index rows_of_pair(const MapGaussian& a, const MapGaussian& b, const Correspondence& pair) {
  return a.landmark(pair.a).has_height() && b.landmark(pair.b).has_height() ? 3 : 2;
}

JointFit fit_jointly(const MapGaussian& a, const MapGaussian& b, std::span<const Correspondence> pairs,
                     const Pose2& start) {
  JointFit fit;
  fit.pairs.assign(pairs.begin(), pairs.end());
  fit.T_a_b = start;
  fit.mean_a = a.mean;
  fit.mean_b = b.mean;
  if (pairs.size() < 2) return fit;
  Constraint constraint(a, b, fit);
  for (int turn = 0; turn < kMostTurns; ++turn) {
    if (!constraint.linearise()) return fit;
    if (constraint.step() < kConverged) break;
  }
  constraint.finish();
  return fit;
}

double chi2_of_pair(const JointFit& fit, std::size_t i) {
  const Eigen::Index row = fit.row_of[i];
  const Eigen::Index rows = (i + 1 < fit.row_of.size() ? fit.row_of[i + 1] : fit.rows) - row;
  const Eigen::VectorXd weighted = fit.weighted_gap.segment(row, rows);
  const Eigen::MatrixXd Q = fit.Q.block(row, row, rows, rows);
  return weighted.dot(Q.ldlt().solve(weighted));
}

double chi2_of_candidate(const MapGaussian& a, const MapGaussian& b, const JointFit& fit, const Correspondence& pair) {
  const Eigen::Index row_a = a.row[pair.a], row_b = b.row[pair.b];
  const Gap between = gap(fit.mean_a.segment<2>(row_a), fit.T_a_b, fit.mean_b.segment<2>(row_b));
  const Eigen::Matrix2d R = -between.by_p_b;
  const Eigen::MatrixXd hU = fit.U_a.middleRows(row_a, 2) - R * fit.U_b.middleRows(row_b, 2);
  const Eigen::Matrix2d prior = a.covariance_of(pair.a) + R * b.covariance_of(pair.b) * R.transpose();
  const Eigen::Matrix2d with_T = -hU * fit.S_inverse_G * fit.covariance_T * between.by_T.transpose();
  const Eigen::Matrix2d covariance = prior - hU * fit.Q * hU.transpose() + with_T + with_T.transpose() +
                                     between.by_T * fit.covariance_T * between.by_T.transpose();
  return between.value_m.dot(covariance.ldlt().solve(between.value_m));
}

}  // namespace azimuth
