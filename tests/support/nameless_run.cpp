#include "tests/support/nameless_run.hpp"

#include <algorithm>
#include <ctime>
#include <map>

#include "slam/estimator/odometry_track.hpp"

namespace azimuth {
namespace {

double all_threads_cpu_time_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct AfterPose {
  PoseId anchor;
  Motion motion;
};

/// A landmark is what most of its bearings are of.
NamelessMapScore map_score(const Hypothesis& hypothesis, const std::vector<Identity>& truth) {
  NamelessMapScore score;
  std::map<Identity, int> landmarks_of;
  for (const LandmarkId id : hypothesis.landmarks()) {
    std::map<Identity, int> counts;
    for (const BearingId bearing : hypothesis.graph().bearings_of(id))
      ++counts[truth[static_cast<std::size_t>(bearing)]];
    const auto most = std::max_element(counts.begin(), counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    ++score.landmarks;
    if (most->first != kUnknownIdentity) ++landmarks_of[most->first];
    for (const auto& [name, count] : counts) {
      score.assigned += count;
      if (name != most->first) score.wrong += count;
    }
  }
  score.mapped = static_cast<int>(landmarks_of.size());
  for (const auto& [name, count] : landmarks_of) score.duplicates += count - 1;
  score.bearings = hypothesis.graph().bearings();
  return score;
}

}  // namespace

NamelessSettings nameless_settings_for(const Rig& rig, const Scene& scene, const SmootherSettings& smoother) {
  NamelessSettings settings;
  settings.beam.hypothesis.scene = scene;
  settings.beam.hypothesis.smoother = smoother;
  settings.beam.hypothesis.costs = hypothesis_costs(scene, smoother);
  settings.floors.distance_m = rig.odometry.floor_distance_m;
  settings.floors.rotation_rad = rig.odometry.floor_rotation_rad;
  return settings;
}

NamelessRun nameless_run(const Run& run, const Rig& rig, const NamelessSettings& settings, Workers& workers,
                         NamelessMapScore& score) {
  NamelessRun result;
  OdometryTrack track(rig.odometry);
  Nameless nameless(settings);
  std::vector<AfterPose> behind;
  std::vector<Identity> truth;
  std::size_t read = 0;
  for (const BearingSet& set : run.bearings) {
    while (read < run.odometry.size() && (track.empty() || track.newest() < set.stamp)) track.add(run.odometry[read++]);
    const OdometryTrack::Step step = track.advance_to(set.stamp);
    BearingSet stripped = set;
    for (Bearing& bearing : stripped.bearings) bearing.identity = kUnknownIdentity;
    const double start_s = all_threads_cpu_time_s();
    nameless.predict(step.motion);
    const bool used = nameless.update(stripped, workers);
    const Beam::PoseBelief pose = nameless.pose();
    if (used) {
      result.step_us.push_back(1e6 * (all_threads_cpu_time_s() - start_s));
      result.gaps.push_back(nameless.beam().gap());
      for (const Bearing& bearing : set.bearings) truth.push_back(bearing.identity);
    }
    result.online.push_back({set.stamp, pose.T_map_body, pose.covariance, step.T_odom_body});
    behind.push_back({nameless.anchor(), nameless.since_anchor_with_floors()});
  }
  std::map<PoseId, Beam::PoseBelief> poses;
  for (std::size_t i = 0; i < behind.size(); ++i) {
    const auto [found, is_new] = poses.try_emplace(behind[i].anchor);
    if (is_new) found->second = nameless.beam().pose(behind[i].anchor);
    const MovedPose moved = apply(found->second.T_map_body, behind[i].motion);
    result.smoothed.push_back({result.online[i].stamp, moved.T_map_body,
                               moved.G * found->second.covariance * moved.G.transpose() + moved.noise,
                               result.online[i].T_odom_body});
  }
  result.energy = nameless.beam().best_energy();
  score = map_score(nameless.beam().best(), truth);
  return result;
}

}  // namespace azimuth
