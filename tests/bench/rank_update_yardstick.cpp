// Lower limit of an EKF step: gain and one symmetric rank-k update of a dense lower triangle, in plain Eigen.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <benchmark/benchmark.h>

#include "tests/bench/step_times.hpp"

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index kPose = 3, kPoint = 2, kSeen = 10;

/// P H^T for bearing rows, which involve the pose and the point `landmark`.
void multiply_rows(const MatrixXd& P, const MatrixXd& H, MatrixXd& PHt) {
  for (Index row = 0; row < H.rows(); ++row) {
    const Index point = kPose + kPoint * (row % kSeen);
    const auto add_column = [&](Index column, double factor) {
      PHt.col(row).head(column) += factor * P.row(column).head(column).transpose();
      PHt.col(row).tail(P.rows() - column) += factor * P.col(column).tail(P.rows() - column);
    };
    PHt.col(row).setZero();
    for (Index i = 0; i < kPose; ++i) add_column(i, H(row, i));
    for (Index i = 0; i < kPoint; ++i) add_column(point + i, H(row, kPose + i));
  }
}

/// S = H P H^T + R from P H^T.
void multiply_left(const MatrixXd& H, const MatrixXd& PHt, MatrixXd& S) {
  for (Index row = 0; row < H.rows(); ++row) {
    const Index point = kPose + kPoint * (row % kSeen);
    S.row(row) = H.row(row).head(kPose) * PHt.topRows(kPose) + H.row(row).tail(kPoint) * PHt.middleRows(point, kPoint);
    S(row, row) += 1e-4;
  }
}

void gain_and_rank_update(benchmark::State& state) {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
    return state.SkipWithError("needs a processor with AVX2 and FMA");
#endif
  const Index n = kPose + kPoint * state.range(0), rows = state.range(1);
  MatrixXd P = MatrixXd::Identity(n, n);
  const MatrixXd H = MatrixXd::Random(rows, kPose + kPoint);
  MatrixXd W(n, rows), S(rows, rows);
  Eigen::LLT<MatrixXd> factor(rows);
  azimuth::bench::StepTimes times(state);
  for (auto _ : state) {
    times.time([&] {
      multiply_rows(P, H, W);
      multiply_left(H, W, S);
      factor.compute(S);
      factor.matrixU().solveInPlace<Eigen::OnTheRight>(W);  // W = P H^T L^-T
      P.selfadjointView<Eigen::Lower>().rankUpdate(W, -1.0);
    });
    P.diagonal().array() += 1e-6;
  }
}

BENCHMARK(gain_and_rank_update)
    ->ArgNames({"landmarks", "rows"})
    ->ArgsProduct({{50, 100, 200, 500, 1000}, {10, 20}})
    ->UseManualTime();

}  // namespace
