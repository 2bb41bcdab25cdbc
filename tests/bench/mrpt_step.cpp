// MRPT's CRangeBearingKFSLAM2D on the same map: 10 range-bearing observations per step, which are 20 rows. Landmark
// identities are given and only landmarks in sight are predicted, which is MRPT's best case.

#include <algorithm>
#include <benchmark/benchmark.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/slam/CRangeBearingKFSLAM2D.h>
#include <vector>

#include "tests/bench/step_times.hpp"
#include "tests/bench/world.hpp"

namespace azimuth {
namespace {

using mrpt::obs::CActionCollection;
using mrpt::obs::CActionRobotMovement2D;
using mrpt::obs::CObservationBearingRange;
using mrpt::obs::CSensoryFrame;

CActionCollection::Ptr drive(double distance_m) {
  CActionRobotMovement2D::TMotionModelOptions model;
  model.modelSelection = CActionRobotMovement2D::mmGaussian;
  CActionRobotMovement2D movement;
  movement.computeFromOdometry(mrpt::poses::CPose2D(distance_m, 0.0, 0.0), model);
  auto actions = CActionCollection::Create();
  actions->insert(movement);
  return actions;
}

/// Observations of the landmarks [first, last) by a robot at `x_m` on the x axis.
CSensoryFrame::Ptr look(const std::vector<Eigen::Vector2d>& landmarks, int first, int last, double x_m,
                        double range_m) {
  auto seen = CObservationBearingRange::Create();
  seen->minSensorDistance = 0.1F;
  seen->maxSensorDistance = static_cast<float>(range_m);
  seen->fieldOfView_yaw = static_cast<float>(2.0 * kPi);
  const Pose2 T_map_body{x_m, 0.0, 0.0};
  for (int i = first; i < last; ++i) {
    const Eigen::Vector2d& landmark = landmarks[static_cast<std::size_t>(i)];
    CObservationBearingRange::TMeasurement measurement;
    measurement.range = static_cast<float>((landmark - T_map_body.position()).norm());
    measurement.yaw = static_cast<float>(bench::azimuth_to(T_map_body, landmark));
    measurement.pitch = 0.0F;
    measurement.landmarkID = i;
    seen->sensedData.push_back(measurement);
  }
  auto frame = CSensoryFrame::Create();
  frame->insert(seen);
  return frame;
}

/// Maps all landmarks from near the origin.
void build_map(mrpt::slam::CRangeBearingKFSLAM2D& filter, const std::vector<Eigen::Vector2d>& landmarks) {
  filter.KF_options.method = mrpt::bayes::kfEKFAlaDavison;
  filter.options.std_sensor_range = 0.05F;
  filter.options.std_sensor_yaw = static_cast<float>(bench::kSigmaBearing_rad);
  const int count = static_cast<int>(landmarks.size());
  for (int first = 0; first < count; first += 50) {
    auto still = drive(0.0);
    auto seen = look(landmarks, first, std::min(count, first + 50), 0.0, 1000.0);
    filter.processActionObservation(still, seen);
  }
}

void mrpt_step(benchmark::State& state, mrpt::bayes::TKFMethod method) {
  const std::vector<Eigen::Vector2d> landmarks = bench::make_landmarks(static_cast<int>(state.range(0)));
  mrpt::slam::CRangeBearingKFSLAM2D filter;
  filter.setMinLoggingLevel(mrpt::system::LVL_ERROR);
  build_map(filter, landmarks);
  filter.KF_options.method = method;
  bench::StepTimes times(state);
  bool forwards = true;
  for (auto _ : state) {
    auto action = drive(forwards ? bench::kStride_m : -bench::kStride_m);
    auto frame = look(landmarks, 0, bench::kSeen, forwards ? bench::kStride_m : 0.0, bench::kSightRange_m);
    times.time([&] { filter.processActionObservation(action, frame); });
    forwards = !forwards;
  }
  state.counters["seen"] = static_cast<double>(filter.getLastDataAssociation().results.associations.size());
}

void mrpt_davison(benchmark::State& state) { mrpt_step(state, mrpt::bayes::kfEKFAlaDavison); }
void mrpt_naive(benchmark::State& state) { mrpt_step(state, mrpt::bayes::kfEKFNaive); }

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("landmarks")->Arg(50)->Arg(100)->Arg(200)->Arg(500)->Arg(1000)->UseManualTime();
}
BENCHMARK(mrpt_davison)->Apply(sizes);
BENCHMARK(mrpt_naive)->Apply(sizes);

}  // namespace
}  // namespace azimuth
