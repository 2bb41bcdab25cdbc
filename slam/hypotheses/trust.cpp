#include "slam/hypotheses/trust.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace azimuth {
namespace {

constexpr PoseId kRecentImages = 12;

// Minimum prior probability that all members of a young map are wrong, and the factor on the covariance of odometry
// that describes the pose of such a map.
constexpr double kWrongAtLeast = 0.2, kWiderWhenWrong = 2.5;
// A map of up to so many images is young. The weight of odometry falls inversely with the number of images beyond.
constexpr double kYoungImages = 36.0;
// Prior probability through a narrow view. Few landmarks are seen at once, and one or two of them close a loop, so most
// maps are wrong somewhere, and members are wrong together.
constexpr double kWrongBeforehandNarrow = 0.9;

// Thresholds beyond which a pose is wrong more often than its covariance says.
constexpr double kMostElsewhere = 0.2, kMostSpread = 3.0;
constexpr double kMostRecentChi2 = 0.7;  // motions are fitted too, so a third is usual
constexpr double kMostWrong = 0.5;
// Twice the share that detection_probability lets one expect.
constexpr double kMostMissing = 0.5;
constexpr std::size_t kEstablished = 4;  // minimum number of bearings of a landmark

/// Share of associated bearings in the last images that have bearings. Images without bearings (a dark camera) count
/// neither for nor against a map.
double share_explained(const Hypothesis& hypothesis) {
  const BearingGraph& graph = hypothesis.graph();
  double explained = 0.0, bearings = 0.0;
  PoseId left = kRecentImages;
  for (PoseId image = hypothesis.images() - 1; image >= 0 && left > 0; --image) {
    const BearingId first = hypothesis.first_bearing(image), end = hypothesis.first_bearing(image + 1);
    for (BearingId id = first; id < end; ++id) explained += graph.landmark_of(id) != kOfNothing ? 1.0 : 0.0;
    bearings += end - first;
    left -= end > first ? 1 : 0;
  }
  return bearings > 0.0 ? explained / bearings : 0.0;
}

/// Share of missed detections of established landmarks, in the last images that have bearings.
double share_missing(const Hypothesis& hypothesis) {
  const BearingGraph& graph = hypothesis.graph();
  const Scene& scene = hypothesis.scene();
  const PoseId first = std::max(0, hypothesis.images() - kRecentImages);
  std::vector<LandmarkId> seen;
  int expected = 0, missing = 0;
  for (PoseId image = first; image < hypothesis.images(); ++image) {
    seen.clear();
    for (BearingId id = hypothesis.first_bearing(image); id < hypothesis.first_bearing(image + 1); ++id)
      seen.push_back(graph.landmark_of(id));
    if (seen.empty()) continue;
    const Pose2 T_map_camera = graph.camera_at(image).T_map_body;
    for (const LandmarkId id : hypothesis.landmarks()) {
      const SmoothedLandmark& landmark = graph.landmark(id);
      if (!landmark.is_point() || graph.bearings_of(id).size() < kEstablished) continue;
      const Eigen::Vector2d away = landmark.p_map() - T_map_camera.position();
      const double azimuth_rad = wrap(std::atan2(away.y(), away.x()) - T_map_camera.heading_rad);
      if (away.norm() > scene.surely_seen_within_m() || !scene.in_view(azimuth_rad)) continue;
      ++expected;
      missing += std::ranges::find(seen, id) == seen.end() ? 1 : 0;
    }
  }
  return expected > 0 ? static_cast<double>(missing) / expected : 0.0;
}

double youth(const TrustEvidence& evidence) { return std::min(1.0, kYoungImages / std::max(evidence.images, 1)); }

/// Bayes' rule: the squared difference between pose and odometry is chi2-distributed with three degrees of freedom when
/// the map is right, and wider by the factor kWiderWhenWrong when the map is wrong.
double wrong_by_odometry(const TrustEvidence& evidence, double wrong_beforehand) {
  const double log_odds_right = std::log(1.0 - wrong_beforehand) - std::log(wrong_beforehand) +
                                1.5 * std::log(kWiderWhenWrong) -
                                0.5 * evidence.odometry_chi2 * (1.0 - 1.0 / kWiderWhenWrong);
  return 1.0 / (1.0 + std::exp(log_odds_right));
}

}  // namespace

TrustEvidence trust_evidence(const Beam& beam, const Beam::PoseBelief& odometry_alone) {
  const Hypothesis& best = beam.best();
  const BearingGraph& graph = best.graph();
  TrustEvidence evidence;
  evidence.narrow_view = best.scene().is_narrow();
  evidence.images = best.images();
  evidence.from_saved_map = best.has_saved_map();
  evidence.landmarks = static_cast<int>(best.landmarks().size());
  evidence.elsewhere = beam.elsewhere();

  evidence.explained = share_explained(best);
  evidence.missing = share_missing(best);

  const PoseId first_motion = std::max(1, best.images() - kRecentImages);
  for (PoseId id = first_motion; id < graph.poses(); ++id) evidence.recent_chi2 += graph.odometry_chi2(id);
  evidence.recent_chi2 /= 3.0 * std::max(1, graph.poses() - first_motion);

  const Beam::PoseBelief pose = beam.newest_pose();
  const auto size = [](const Eigen::Matrix3d& P) { return P(0, 0) + P(1, 1); };
  const double own = size(best.smoother().newest_covariance());
  evidence.spread = own > 0.0 ? std::sqrt(size(pose.covariance) / own) : 1.0;

  Eigen::Vector3d off = pose.T_map_body.vector() - odometry_alone.T_map_body.vector();
  off.z() = wrap(off.z());
  const Eigen::LDLT<Eigen::Matrix3d> factor(odometry_alone.covariance);
  evidence.odometry_chi2 = factor.isPositive() ? off.dot(factor.solve(off)) : 0.0;
  return evidence;
}

Trust trust(const TrustEvidence& evidence) {
  if (evidence.landmarks == 0) return {"no landmark found yet"};
  if (evidence.narrow_view) return {"too few landmarks at once to tell them apart"};
  // The covariance of the first metres comes from odometry alone, and nothing has had time to contradict it.
  if (evidence.images < kRecentImages && !evidence.from_saved_map) return {"too little seen yet to tell"};
  if (evidence.elsewhere > kMostElsewhere || evidence.spread > kMostSpread)
    return {"several maps explain what was seen"};
  if (probability_all_wrong(evidence) > kMostWrong) {
    TrustEvidence agreeing = evidence;
    agreeing.odometry_chi2 = 0.0;
    return {probability_all_wrong(agreeing) > kMostWrong ? "the map explains too little of what is seen"
                                                         : "the map contradicts the odometry"};
  }
  if (evidence.recent_chi2 > kMostRecentChi2) return {"the map bends what odometry says"};
  if (evidence.missing > kMostMissing) return {"landmarks that should be seen are missing"};
  return {};
}

Trust trust(const TrustEvidence& evidence, const RecentDoubts& recent) {
  const Trust by_itself = trust(evidence);
  if (by_itself.trusted() && recent.prevail()) return {"the map was in doubt too often lately"};
  return by_itself;
}

void RecentDoubts::add(const TrustEvidence& evidence) {
  if (evidence.images < kRecentImages && !evidence.from_saved_map) return;  // too few images to judge
  constexpr std::uint64_t kKept = (std::uint64_t{1} << kImages) - 1;
  doubted_ = (doubted_ << 1U | (trust(evidence).trusted() ? 0U : 1U)) & kKept;
  images_ = std::min(images_ + 1, kImages);
}

/// The prior probability is y u + (1 - y) u^2, with u the share of unexplained bearings and y the map's youth
/// (mathematics VI.20).
double probability_all_wrong(const TrustEvidence& evidence) {
  const double young = youth(evidence), unexplained = 1.0 - evidence.explained;
  const double beforehand = std::max(kWrongAtLeast * young, unexplained * (young + (1.0 - young) * unexplained));
  return wrong_by_odometry(evidence, evidence.narrow_view ? kWrongBeforehandNarrow : beforehand);
}

double share_of_odometry(const TrustEvidence& evidence) {
  // The prior here is higher than in probability_all_wrong(): drives shorter than a lap need odometry before the map
  // counts as wrong.
  const double wrong = wrong_by_odometry(
      evidence, evidence.narrow_view ? kWrongBeforehandNarrow : std::max(kWrongAtLeast, 1.0 - evidence.explained));
  return wrong * (1.0 - wrong) * youth(evidence);
}

}  // namespace azimuth
