// Ceres on the same graph: checks that it finds the same minimum, and measures the time to find it after one more
// image.

#include <array>
#include <benchmark/benchmark.h>
#include <ceres/ceres.h>
#include <cmath>

#include "tests/bench/smoother_world.hpp"
#include "tests/bench/step_times.hpp"
#include "tests/support/batch_solution.hpp"

namespace azimuth {
namespace {

template <class T>
T wrapped(const T& angle_rad) {
  return atan2(sin(angle_rad), cos(angle_rad));
}

struct OdometryCost {
  OdometryMeasurement measured;
  template <class T>
  bool operator()(const T* start, const T* end, T* residuals) const {
    const T c = cos(start[2]), s = sin(start[2]), dx = end[0] - start[0], dy = end[1] - start[1];
    const std::array<T, 3> off{c * dx + s * dy - measured.relative.x(), c * dy - s * dx - measured.relative.y(),
                               wrapped(T(end[2] - start[2] - measured.relative.z()))};
    for (int i = 0; i < 3; ++i) {
      residuals[i] = T(0.0);
      for (int k = 0; k < 3; ++k) residuals[i] += measured.whitening(i, k) * off[static_cast<std::size_t>(k)];
    }
    return true;
  }
};

struct BearingCost {
  BearingMeasurement measured;
  Eigen::Vector2d chart;
  template <class T>
  bool operator()(const T* pose, const T* landmark, T* residual) const {
    const T Bx = landmark[1] * (chart.x() - pose[0]) + cos(landmark[0]);
    const T By = landmark[1] * (chart.y() - pose[1]) + sin(landmark[0]);
    *residual = wrapped(T(atan2(By, Bx) - pose[2] - measured.azimuth_rad)) / measured.sigma_rad;
    return true;
  }
};

struct DepthCost {
  double mean, sigma;
  template <class T>
  bool operator()(const T* landmark, T* residual) const {
    *residual = (landmark[1] - mean) / sigma;
    return true;
  }
};

/// The graph's measurements, with its current values as start.
class CeresGraph {
 public:
  explicit CeresGraph(const BearingGraph& graph, const SmootherSettings& settings) {
    const BearingGraph::Values values = graph.values();
    for (const SmoothedPose& pose : values.poses)
      poses_.push_back({pose.T_map_body.x_m, pose.T_map_body.y_m, pose.T_map_body.heading_rad});
    for (const SmoothedLandmark& landmark : values.landmarks)
      landmarks_.push_back({landmark.direction_rad, landmark.inverse_distance_per_m});
    for (PoseId id = 1; id < graph.poses(); ++id)
      problem_.AddResidualBlock(
          new ceres::AutoDiffCostFunction<OdometryCost, 3, 3, 3>(new OdometryCost{graph.odometry_to(id)}), nullptr,
          poses_[at(id - 1)].data(), poses_[at(id)].data());
    for (BearingId id = 0; id < graph.bearings(); ++id) {
      const LandmarkId landmark = graph.landmark_of(id);
      problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<BearingCost, 1, 3, 2>(
                                    new BearingCost{graph.bearing(id), graph.landmark(landmark).p_map_chart}),
                                new ceres::CauchyLoss(settings.kernel_width), poses_[at(graph.bearing(id).pose)].data(),
                                landmarks_[at(landmark)].data());
    }
    for (auto& landmark : landmarks_)
      problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<DepthCost, 1, 2>(new DepthCost{
                                    settings.inverse_depth_mean_per_m, settings.inverse_depth_sigma_per_m}),
                                nullptr, landmark.data());
    problem_.SetParameterBlockConstant(poses_.front().data());
  }

  ceres::Solver::Summary solve(double tolerance) {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.max_num_iterations = 100;
    options.function_tolerance = tolerance;
    options.gradient_tolerance = options.parameter_tolerance = 1e-16;
    options.num_threads = 1;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary;
  }

  double largest_difference(const BearingGraph::Values& values) const {
    BearingGraph::Values mine = values;
    for (std::size_t i = 0; i < poses_.size(); ++i)
      mine.poses[i] = SmoothedPose({poses_[i][0], poses_[i][1], poses_[i][2]});
    for (std::size_t i = 0; i < landmarks_.size(); ++i)
      mine.landmarks[i] = {values.landmarks[i].p_map_chart, landmarks_[i][0], landmarks_[i][1]};
    return azimuth::largest_difference(mine, values);
  }

 private:
  static std::size_t at(std::int32_t id) { return static_cast<std::size_t>(id); }
  std::vector<std::array<double, 3>> poses_;
  std::vector<std::array<double, 2>> landmarks_;
  ceres::Problem problem_;
};

void ceres_one_more_image(benchmark::State& state) {
  const auto images = static_cast<int>(state.range(0));
  SmootherSettings settings;
  settings.converged_below = 1e-18;
  const NamedDrive drive = bench::long_drive(images + 1);
  DriveFeeder feeder(drive);
  Smoother smoother = bench::driven(feeder, images, settings);
  feeder.feed(smoother);
  {
    bench::StepTimes times(state);
    for (auto _ : state) {
      CeresGraph graph(smoother.graph(), settings);
      times.time([&] { graph.solve(1e-6); });
    }
  }
  // After convergence both must find the same minimum.
  CeresGraph graph(smoother.graph(), settings);
  const ceres::Solver::Summary summary = graph.solve(1e-16);
  smoother.optimise(500);
  state.counters["energy_differs"] = std::abs(summary.final_cost - smoother.energy());
  state.counters["values_differ"] = graph.largest_difference(smoother.graph().values());
}
BENCHMARK(ceres_one_more_image)->ArgName("keyframes")->Arg(300)->Arg(1500)->Arg(4500)->UseManualTime()->MinTime(0.2);

}  // namespace
}  // namespace azimuth
