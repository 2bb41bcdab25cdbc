#include "tools/replay/replay.hpp"

#include <deque>
#include <utility>

#include "slam/estimator/estimate_digest.hpp"

namespace azimuth {
namespace {

/// Wraps an estimator and measures the time of update().
class TimedEstimator final : public Estimator {
 public:
  /// `update_us` receives the duration of each update() and must outlive this object.
  TimedEstimator(std::unique_ptr<Estimator> estimator, std::vector<double>& update_us)
      : estimator_(std::move(estimator)), update_us_(update_us) {}

  bool odometry_begins(bool goes_on) override { return estimator_->odometry_begins(goes_on); }
  void predict(const Motion& motion) override { estimator_->predict(motion); }
  void update(const BearingSet& observations) override {
    const StopWatch watch;
    estimator_->update(observations);
    update_us_.push_back(watch.elapsed_us());
  }
  void estimate(Estimate& out) const override { estimator_->estimate(out); }
  void look_ahead(const Motion& motion, Estimate& out) const override { estimator_->look_ahead(motion, out); }
  void expect(std::vector<ExpectedBearing>& out) const override { estimator_->expect(out); }
  std::optional<CameraErrors> camera_errors() const override { return estimator_->camera_errors(); }
  RigFinding rig_finding() const override { return estimator_->rig_finding(); }
  bool save_map(MapSnapshot& out) const override { return estimator_->save_map(out); }
  bool write_past(std::vector<PastPose>& out) const override { return estimator_->write_past(out); }
  bool write_path(std::vector<PathPose>& out) const override { return estimator_->write_path(out); }
  void conclude() override { estimator_->conclude(); }

 private:
  std::unique_ptr<Estimator> estimator_;
  std::vector<double>& update_us_;
};

class Replay {
 public:
  Replay(const Run& run, const Rig& rig, std::unique_ptr<Estimator> estimator, const StageSettings& settings)
      : run_(run),
        yaw_offset_rad_(rig.camera.yaw_offset_rad),
        stage_(std::make_unique<TimedEstimator>(std::move(estimator), result_.times.update_us), rig, settings,
               run.since_map) {}

  /// Borrows `watch`.
  void watch(const ReplayWatch& watch) {
    watch_ = &watch;
    if (!watch.before_update) return;
    stage_.before_update([this](const BearingSet& set, const Estimator& before) {
      const StopWatch looking;
      watch_->before_update(set, before);
      looked_on_us_ += looking.elapsed_us();
    });
  }

  ReplayResult run(SetSource& sets, const Progress& progress, Ending ending) {
    BearingSet set;
    for (std::size_t given = 1; sets.next(set); ++given) {
      costs_.push_back({set.stamp, sets.last_us()});
      if (set.trouble != ImageTrouble::none) ++result_.images.troubles[set.trouble];
      add_odometry_until(set.stamp);
      stage_.add(set);
      step();
      if (progress) progress(given, sets.count());
    }
    if (!run_.odometry.empty()) add_odometry_until(run_.odometry.back().stamp);
    stage_.finish();
    step();
    result_.digest = digest_.value();
    result_.samples = stage_.samples().finding();
    if (ending == Ending::concluded) conclude();
    if (!stage_.estimator().write_past(result_.past)) result_.past.clear();
    if (MapSnapshot map; stage_.save_map(map)) result_.map = std::move(map);
    return std::move(result_);
  }

 private:
  void conclude() {
    stage_.conclude();
    result_.last.landmarks.clear();
    result_.last.accepted.clear();
    if (!result_.estimates.empty()) stage_.estimator().estimate(result_.last);
  }

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
      const double advance_us = watch.elapsed_us() - std::exchange(looked_on_us_, 0.0);
      const Estimate& estimate = result_.last;
      result_.times.step_us.push_back(advance_us + cost_of(estimate.stamp));
      digest_.add(estimate);
      result_.estimates.push_back(
          {estimate.stamp, estimate.T_map_body, estimate.pose_covariance, estimate.T_odom_body});
      add_health(estimate);
      for (const AcceptedSighting& sighting : estimate.accepted)
        result_.sightings.push_back(
            {estimate.stamp, sighting.landmark_id, wrap(sighting.azimuth_rad + yaw_offset_rad_), sighting.sigma_rad});
      if (watch_ && watch_->after_step) watch_->after_step(estimate);
    }
  }

  void add_health(const Estimate& estimate) {
    const std::uint64_t used = estimate.association.accepted + estimate.association.created;
    result_.healths.push_back({estimate.stamp, estimate.health, estimate.reason, used > used_});
    used_ = used;
  }

  /// Time that the front end took for the bearing set of this step. Skips sets that made no step.
  double cost_of(Stamp stamp) {
    while (!costs_.empty() && costs_.front().stamp < stamp) costs_.pop_front();
    if (costs_.empty() || costs_.front().stamp != stamp) return 0.0;
    const double found_us = costs_.front().found_us;
    costs_.pop_front();
    return found_us;
  }

  struct Cost {
    Stamp stamp;
    double found_us;
  };

  const Run& run_;
  ReplayResult result_;  // declared before the stage, whose estimator writes its times to it
  double yaw_offset_rad_;
  EstimatorStage stage_;
  EstimateDigest digest_;
  std::deque<Cost> costs_;
  const ReplayWatch* watch_ = nullptr;
  double looked_on_us_ = 0.0;  // time of the observers within the present step
  std::size_t reading_ = 0;
  std::uint64_t used_ = 0;  // number of used bearings
};

}  // namespace

ReplayResult replay(const Run& run, const Rig& rig, std::unique_ptr<Estimator> estimator, const StageSettings& settings,
                    const Progress& progress, Ending ending, const ReplayWatch& watch) {
  RecordedSets sets(run);
  Replay replay(run, rig, std::move(estimator), settings);
  replay.watch(watch);
  return replay.run(sets, progress, ending);
}

ReplayResult replay_images(const Run& run, const Rig& rig, ImageFrontEnd front_end,
                           std::unique_ptr<Estimator> estimator, const StageSettings& settings,
                           const Progress& progress, Ending ending, const ReplayWatch& watch) {
  SeenSets sets(run, rig.camera.image, std::move(front_end));
  Replay replay(run, rig, std::move(estimator), settings);
  replay.watch(watch);
  ReplayResult result = replay.run(sets, progress, ending);
  result.times.decode_us = sets.decode_us();
  result.times.detect_us = sets.detect_us();
  result.images.images = sets.count();
  result.images.first_unreadable = sets.first_unreadable();
  return result;
}

}  // namespace azimuth
