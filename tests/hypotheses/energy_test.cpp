#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

#include "tests/hypotheses/nameless_world.hpp"

namespace azimuth {
namespace {

/// The energy of the hypothesis computed from its poses, landmarks and pairs alone, term by term.
double energy_term_by_term(const Hypothesis& hypothesis, const HypothesisSettings& settings, double missed_scale) {
  const BearingGraph& graph = hypothesis.graph();
  double energy = 0.0;
  for (PoseId id = 1; id < graph.poses(); ++id) {
    const Pose2 T = inverse(graph.pose(id - 1)) * graph.pose(id);
    Eigen::Vector3d off = T.vector() - graph.odometry_to(id).relative;
    off.z() = wrap(off.z());
    const double m = NamelessWorld::sigma_motion_m(), rad = NamelessWorld({}).sigma_motion_rad();
    energy += 0.5 * ((off.x() * off.x() + off.y() * off.y()) / (m * m) + off.z() * off.z() / (rad * rad));
  }
  std::map<LandmarkId, std::set<PoseId>> seen_from;
  for (BearingId id = 0; id < graph.bearings(); ++id) {
    const BearingMeasurement& bearing = graph.bearing(id);
    const LandmarkId landmark = graph.landmark_of(id);
    if (landmark == kOfNothing) {
      energy += settings.costs.unassigned;
      continue;
    }
    seen_from[landmark].insert(bearing.pose);
    const Eigen::Vector2d away = graph.landmark(landmark).p_map() - graph.pose(bearing.pose).position();
    const double off =
        wrap(std::atan2(away.y(), away.x()) - graph.pose(bearing.pose).heading_rad - bearing.azimuth_rad) / kSigma_rad;
    energy += std::min(0.5 * off * off, settings.costs.unassigned);
  }
  for (const auto& [landmark, images] : seen_from) {
    energy += settings.costs.landmark;
    for (PoseId id = *images.begin(); id <= std::min(*images.rbegin() + 12, graph.poses() - 1); ++id)
      if (!images.contains(id) && (graph.landmark(landmark).p_map() - graph.pose(id).position()).norm() < 0.9 * 6.0)
        energy += missed_scale * settings.costs.missed;
  }
  return energy;
}

TEST(Energy, IsTheSumOfItsTerms) {
  NamelessWorld world(ring_of_landmarks());
  MemberSettings member;
  member.missed_scale = 1.3;
  Hypothesis hypothesis = driven(world, 14, nullptr, member);
  ASSERT_GE(hypothesis.landmarks().size(), 4U);
  EXPECT_NEAR(hypothesis.energy(), energy_term_by_term(hypothesis, world_settings(), 1.3), 1e-6);

  // A bearing without a landmark costs, and its landmark counts as missed in that image.
  const LandmarkId landmark = hypothesis.landmarks().front();
  const std::vector<BearingId> bearings = hypothesis.graph().bearings_of(landmark);
  hypothesis.assign(bearings[bearings.size() / 2], kOfNothing);
  EXPECT_NEAR(hypothesis.energy(), energy_term_by_term(hypothesis, world_settings(), 1.3), 1e-6);
}

TEST(Energy, ALandmarkThatIsNotSeenAnyMoreIsMissedTwelveTimes) {
  NamelessWorld world(ring_of_landmarks());
  Hypothesis hypothesis = driven(world, 14);
  const int missed = hypothesis.missed();
  const int should_be_seen = static_cast<int>(std::ranges::count_if(hypothesis.landmarks(), [&](LandmarkId id) {
    return (hypothesis.graph().landmark(id).p_map() - hypothesis.smoother().newest_pose().position()).norm() < 5.0;
  }));
  ASSERT_GE(should_be_seen, 2);
  // Images without bearings, all from one place.
  const auto stand = [&](int images) {
    for (int image = 0; image < images; ++image) hypothesis.add_image(world.motion(on_circle(13), on_circle(13)), {});
    return hypothesis.missed() - missed;
  };
  const int landmarks = static_cast<int>(hypothesis.landmarks().size());
  const int by_six = stand(6);
  EXPECT_GE(by_six, 6 * should_be_seen);
  EXPECT_LE(by_six, 6 * landmarks);
  const int by_twenty = stand(14);
  EXPECT_GE(by_twenty, 11 * should_be_seen);
  EXPECT_LE(by_twenty, 12 * landmarks);
}

TEST(Energy, TheTruthIsNotDearerThanPairsThatAreSwapped) {
  NamelessWorld world(ring_of_landmarks());
  Hypothesis hypothesis = driven(world, 14);
  const double right = hypothesis.energy();
  // The first two assigned bearings of the newest image are swapped.
  std::vector<BearingId> of_something;
  for (BearingId id = hypothesis.first_bearing(13); id < hypothesis.graph().bearings(); ++id)
    if (hypothesis.graph().landmark_of(id) != kOfNothing) of_something.push_back(id);
  ASSERT_GE(of_something.size(), 2U);
  const LandmarkId a = hypothesis.graph().landmark_of(of_something[0]);
  const LandmarkId b = hypothesis.graph().landmark_of(of_something[1]);
  hypothesis.assign(of_something[0], kOfNothing);
  hypothesis.assign(of_something[1], a);
  hypothesis.assign(of_something[0], b);
  EXPECT_GT(hypothesis.energy(), right + 1.0);
}

}  // namespace
}  // namespace azimuth
