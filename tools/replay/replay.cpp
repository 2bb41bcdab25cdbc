#include "tools/replay/replay.hpp"

#include <utility>

#include "slam/estimator/estimate_digest.hpp"
#include "tools/replay/stop_watch.hpp"
#include "tools/replay/timed_estimator.hpp"

namespace azimuth {
namespace {

class Replay {
 public:
  Replay(const Run& run, const Rig& rig, std::unique_ptr<Estimator> estimator, const StageSettings& settings)
      : run_(run),
        stage_(std::make_unique<TimedEstimator>(std::move(estimator), result_.times.update_us), rig, settings) {}

  ReplayResult run(const Progress& progress) {
    for (const BearingSet& set : run_.bearings) {
      add_odometry_until(set.stamp);
      BearingSet given = set;  // the stage keeps its storage
      stage_.add(given);
      step();
      if (progress) progress(++sets_, run_.bearings.size());
    }
    if (!run_.odometry.empty()) add_odometry_until(run_.odometry.back().stamp);
    stage_.finish();
    step();
    result_.digest = digest_.value();
    return std::move(result_);
  }

 private:
  void add_odometry_until(Stamp stamp) {
    for (; reading_ < run_.odometry.size() && run_.odometry[reading_].stamp <= stamp; ++reading_) {
      stage_.add(run_.odometry[reading_]);
      step();
    }
  }

  void step() {
    for (;;) {
      const StopWatch watch;
      if (!stage_.advance(result_.last)) return;
      result_.times.step_us.push_back(watch.elapsed_us());
      const Estimate& estimate = result_.last;
      digest_.add(estimate);
      result_.estimates.push_back(
          {estimate.stamp, estimate.T_map_body, estimate.pose_covariance, estimate.T_odom_body});
    }
  }

  const Run& run_;
  ReplayResult result_;  // before the stage, whose estimator writes its times into it
  EstimatorStage stage_;
  EstimateDigest digest_;
  std::size_t reading_ = 0, sets_ = 0;
};

}  // namespace

ReplayResult replay(const Run& run, const Rig& rig, std::unique_ptr<Estimator> estimator, const StageSettings& settings,
                    const Progress& progress) {
  return Replay(run, rig, std::move(estimator), settings).run(progress);
}

}  // namespace azimuth
