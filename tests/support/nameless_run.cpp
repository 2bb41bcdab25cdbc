#include "tests/support/nameless_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <map>

#include "tests/support/cpu_time.hpp"
#include "tests/support/run_steps.hpp"

namespace azimuth {
namespace {

struct AfterPose {
  PoseId anchor;
  Motion motion;
};

/// The true landmark of a mapped landmark is the one that most of its bearings belong to.
NamelessMapScore map_score(const Nameless& nameless, const std::vector<Identity>& truth) {
  const Hypothesis& hypothesis = nameless.beam().best();
  NamelessMapScore score;
  std::map<Identity, int> landmarks_of;
  for (const LandmarkId id : hypothesis.landmarks()) {
    std::map<Identity, int> counts;
    for (const BearingId bearing : hypothesis.graph().bearings_of(id))
      ++counts[truth[static_cast<std::size_t>(nameless.number_of(bearing))]];
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

std::vector<PosePair> pairs_of(const Run& run, const std::vector<EstimateRecord>& records) {
  std::vector<StampedPose> truth, estimated;
  for (const TruthPose& pose : run.truth) truth.push_back({pose.stamp, pose.T_world_body});
  for (const EstimateRecord& record : records) estimated.push_back({record.stamp, record.T_map_body});
  return pair_with_truth(estimated, truth);
}

/// Appends the true names of the newest bearings. The hypothesis may have merged several bearings of an image into one.
void append_names(const BearingSet& set, const Hypothesis& hypothesis, std::vector<Identity>& truth) {
  const BearingGraph& graph = hypothesis.graph();
  for (BearingId id = hypothesis.first_bearing(hypothesis.images() - 1); id < graph.bearings(); ++id) {
    const auto off = [&](const Bearing& bearing) {
      return std::abs(wrap(bearing.azimuth_rad - graph.bearing(id).azimuth_rad));
    };
    truth.push_back(std::min_element(set.bearings.begin(), set.bearings.end(), [&](const Bearing& a, const Bearing& b) {
                      return off(a) < off(b);
                    })->identity);
  }
}

std::string trace_of(const Nameless& nameless) {
  const TrustEvidence& evidence = nameless.evidence();
  const Eigen::Matrix3d P = nameless.beam().newest_pose().covariance;
  return fmt::format("{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{},{:.2f},{},{:.3f},{:.3f},{:.2f},{:.2f},{:.2f},{:.3f}",
                     P(0, 0), P(0, 1), P(0, 2), P(1, 1), P(1, 2), P(2, 2), nameless.anchor(), nameless.beam().gap(),
                     evidence.landmarks, evidence.explained, evidence.elsewhere, evidence.spread, evidence.recent_chi2,
                     evidence.odometry_chi2, evidence.missing);
}

}  // namespace

NamelessSettings nameless_settings_for(const Rig& rig) {
  NamelessSettings settings;
  settings.beam = beam_settings_for(rig.camera.sigma_bearing_rad, rig.camera.field_of_view_rad);
  settings.floors.distance_m = rig.odometry.floor_distance_m;
  settings.floors.rotation_rad = rig.odometry.floor_rotation_rad;
  settings.sigma_scale_distance = rig.odometry.sigma_scale_distance;
  settings.sigma_scale_turn = rig.odometry.sigma_scale_turn;
  return settings;
}

NamelessRun nameless_run(const Run& run, const Rig& rig, const NamelessSettings& settings, Workers& workers,
                         NamelessMapScore& score) {
  NamelessRun result;
  Nameless nameless(settings);
  std::vector<AfterPose> behind;
  std::vector<Identity> truth;
  for_each_step(run, rig, [&](const BearingSet& set, const OdometryTrack::Step& step) {
    BearingSet stripped = set;
    for (Bearing& bearing : stripped.bearings) bearing.identity = kUnknownIdentity;
    const double start_s = cpu_time_s(CLOCK_PROCESS_CPUTIME_ID);
    nameless.predict(step.motion);
    const bool used = nameless.update(stripped, workers);
    const Beam::PoseBelief pose = nameless.pose();
    if (used) {
      append_names(set, nameless.beam().best(), truth);
      if (nameless.is_full()) nameless.forget(workers);
      result.step_us.push_back(1e6 * (cpu_time_s(CLOCK_PROCESS_CPUTIME_ID) - start_s));
      result.used.push_back({result.online.size(), nameless.trust(), trace_of(nameless)});
    }
    result.trust.push_back(nameless.trust());
    result.online.push_back({set.stamp, pose.T_map_body, pose.covariance, step.T_odom_body});
    const Beam::PoseBelief odometry = nameless.odometry_alone();
    result.odometry.push_back({set.stamp, odometry.T_map_body, odometry.covariance, step.T_odom_body});
    behind.push_back({nameless.anchor(), nameless.since_anchor_with_floors()});
  });
  std::map<PoseId, Beam::PoseBelief> poses;
  for (std::size_t i = 0; i < behind.size(); ++i) {
    const auto [found, is_new] = poses.try_emplace(behind[i].anchor);
    if (is_new) found->second = nameless.past(behind[i].anchor);
    const MovedPose moved = apply(found->second.T_map_body, behind[i].motion);
    result.smoothed.push_back({result.online[i].stamp, moved.T_map_body,
                               moved.G * found->second.covariance * moved.G.transpose() + moved.noise,
                               result.online[i].T_odom_body});
  }
  result.energy = nameless.beam().best_energy();
  score = map_score(nameless, truth);
  return result;
}

std::vector<std::optional<Eigen::Vector3d>> errors_of_each(const Run& run, const std::vector<EstimateRecord>& records) {
  const std::vector<PosePair> pairs = pairs_of(run, records);
  std::vector<std::optional<Eigen::Vector3d>> errors(records.size());
  for (const PosePair& pair : pairs) {
    const Pose2 truth = pairs.front().estimated * (inverse(pairs.front().T_world_body) * pair.T_world_body);
    Eigen::Vector3d off = pair.estimated.vector() - truth.vector();
    off.z() = wrap(off.z());
    errors[pair.index] = off;
  }
  return errors;
}

TrustScore trust_score(const Run& run, const NamelessRun& result) {
  const std::vector<PosePair> pairs = pairs_of(run, result.online);
  if (pairs.size() < 2) return {};
  std::vector<PosePair> trusted{pairs.front()};
  std::copy_if(pairs.begin() + 1, pairs.end(), std::back_inserter(trusted),
               [&](const PosePair& pair) { return result.trust[pair.index].trusted(); });
  return {static_cast<double>(trusted.size() - 1) / static_cast<double>(pairs.size() - 1),
          consistency(trusted, result.online).anees};
}

}  // namespace azimuth
