// Merging two maps: their relative pose, the consistency of the covariance, and the cases that are refused.

#include "slam/map_merge/merge_maps.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "drivers/storage/map_codec.hpp"
#include "tests/map_merge/map_pair.hpp"

namespace azimuth::test {
namespace {

const Pose2 kWorldA{10.0, 5.0, 0.7}, kWorldB{40.0, 9.0, -2.4};

struct Halves {
  DrawnMap a, b;
  std::vector<TrueLandmark3> in_a, in_b;
};

Halves halves_of(const std::vector<TrueLandmark3>& hall, RandomDraws& draws, bool heights = true) {
  Halves halves;
  halves.in_a = between(hall, 0.0, 37.0);
  halves.in_b = between(hall, 23.0, 60.0);
  halves.a = drawn_map(halves.in_a, kWorldA, draws, heights);
  halves.b = drawn_map(halves.in_b, kWorldB, draws, heights);
  return halves;
}

Eigen::MatrixXd full(const PackedSymmetric& packed) {
  Eigen::MatrixXd matrix(as_index(packed.size()), as_index(packed.size()));
  for (std::size_t r = 0; r < packed.size(); ++r)
    for (std::size_t c = 0; c < packed.size(); ++c) matrix(as_index(r), as_index(c)) = packed(r, c);
  return matrix;
}

/// The errors of the landmarks in a's frame, each relative to the nearest true landmark.
Eigen::VectorXd landmark_errors(const MapSnapshot& map, const std::vector<TrueLandmark3>& hall) {
  std::vector<double> errors;
  for (const MapLandmark& landmark : map.landmarks) {
    const Eigen::Vector2d p_world = kWorldA * landmark.p_map_landmark_m;
    const auto off_m = [&](const TrueLandmark3& lamp) { return (lamp.p_world_m.head<2>() - p_world).norm(); };
    const TrueLandmark3& truth = *std::ranges::min_element(hall, {}, off_m);
    const Eigen::Vector2d off =
        landmark.p_map_landmark_m - inverse(kWorldA) * Eigen::Vector2d(truth.p_world_m.head<2>());
    errors.insert(errors.end(), {off.x(), off.y()});
    if (landmark.has_height()) errors.push_back(landmark.z_map_landmark_m - truth.p_world_m.z());
  }
  return Eigen::Map<Eigen::VectorXd>(errors.data(), as_index(errors.size()));
}

/// Sums over many merges of quantities that are chi squared if the covariances are consistent.
struct Honesty {
  double nees = 0.0, nees_T = 0.0, chi2 = 0.0;
  Eigen::Index dimensions = 0;
  std::size_t degrees = 0;

  void add(const MergedMaps& merged, const std::vector<TrueLandmark3>& hall) {
    const Eigen::VectorXd error = landmark_errors(merged.map, hall);
    ASSERT_EQ(as_size(error.size()) + merged.map.first_landmark_entry(), merged.map.entries());
    const Eigen::MatrixXd P = full(merged.map.covariance).bottomRightCorner(error.size(), error.size());
    nees += error.dot(P.ldlt().solve(error));
    dimensions += error.size();
    Eigen::Vector3d off = merged.T_a_b.vector() - (inverse(kWorldA) * kWorldB).vector();
    off.z() = wrap(off.z());
    nees_T += off.dot(merged.covariance.ldlt().solve(off));
    chi2 += merged.chi2;
    degrees += merged.degrees;
  }
};

void expect_chi2(double value, double freedom, const char* what) {
  std::printf("%s: %.4f of what is expected, %.0f degrees\n", what, value / freedom, freedom);
  EXPECT_NEAR(value, freedom, 4.0 * std::sqrt(2.0 * freedom)) << what;
}

void expect_honest(bool names, unsigned seeds) {
  Honesty honesty;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    RandomDraws draws(seed);
    const std::vector<TrueLandmark3> hall = drawn_hall(draws, names);
    const Halves halves = halves_of(hall, draws, !names);
    const MergedMaps merged = merge_maps(halves.a.map, halves.b.map);
    ASSERT_EQ(merged.refusal, MergeRefusal::none) << "seed " << seed;
    EXPECT_EQ(merged.map.landmarks.size(), hall.size()) << "seed " << seed;
    EXPECT_EQ(implausible(merged.map), std::nullopt);
    honesty.add(merged, hall);
  }
  expect_chi2(honesty.nees, static_cast<double>(honesty.dimensions), "landmarks");
  expect_chi2(honesty.nees_T, 3.0 * seeds, "transform");
  expect_chi2(honesty.chi2, static_cast<double>(honesty.degrees), "gaps");
}

std::string kind_of(const testing::TestParamInfo<bool>& named) { return named.param ? "named" : "lamps"; }

class MergeMaps : public testing::TestWithParam<bool> {};
TEST_P(MergeMaps, CovariancesAreHonest) { expect_honest(GetParam(), 4); }
INSTANTIATE_TEST_SUITE_P(Landmarks, MergeMaps, testing::Bool(), kind_of);

class ManyMerges : public testing::TestWithParam<bool> {};
TEST_P(ManyMerges, CovariancesAreHonest) { expect_honest(GetParam(), 100); }
INSTANTIATE_TEST_SUITE_P(Landmarks, ManyMerges, testing::Bool(), kind_of);

TEST(MergeMapsOnce, PoseAndCameraAreThoseOfTheFirst) {
  RandomDraws draws(3);
  const Halves halves = halves_of(drawn_hall(draws), draws);
  const MergedMaps merged = merge_maps(halves.a.map, halves.b.map);
  ASSERT_EQ(merged.refusal, MergeRefusal::none);
  EXPECT_EQ(merged.map.camera.size(), 2U);
  EXPECT_LT((merged.map.T_map_body.position() - halves.a.map.T_map_body.position()).norm(), 0.3);
  EXPECT_EQ(merged.common + merged.added, halves.in_b.size());
  for (std::size_t i = 0; i < halves.a.map.entries(); ++i)
    EXPECT_LE(merged.map.covariance(i, i), halves.a.map.covariance(i, i) * (1.0 + 1e-9)) << "more is known than before";
}

TEST(MergeMapsOnce, AnotherHallIsRefused) {
  int refused = 0;
  constexpr int kSeeds = 40;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    RandomDraws draws(seed);
    const std::vector<TrueLandmark3> one = drawn_hall(draws), other = drawn_hall(draws);
    const DrawnMap a = drawn_map(between(one, 0.0, 37.0), kWorldA, draws);
    const DrawnMap b = drawn_map(between(other, 23.0, 60.0), kWorldB, draws);
    if (merge_maps(a.map, b.map).refusal == MergeRefusal::no_overlap) ++refused;
  }
  EXPECT_EQ(refused, kSeeds);
}

TEST(MergeMapsOnce, MapsThatOnlyTouchAreRefused) {
  RandomDraws draws(8);
  const std::vector<TrueLandmark3> hall = drawn_hall(draws);
  const DrawnMap a = drawn_map(between(hall, 0.0, 28.0), kWorldA, draws);
  const DrawnMap b = drawn_map(between(hall, 28.0, 60.0), kWorldB, draws);
  EXPECT_EQ(merge_maps(a.map, b.map).refusal, MergeRefusal::no_overlap);
}

TEST(MergeMapsOnce, ARegularHallFitsInSeveralWays) {
  RandomDraws draws(9);
  std::vector<TrueLandmark3> hall;
  for (double x = 3.0; x < 60.0; x += 6.0)
    for (double y = 2.0; y < 20.0; y += 5.0) hall.push_back({{x, y, 6.5}, kUnknownIdentity});
  const Halves halves = halves_of(hall, draws);
  EXPECT_EQ(merge_maps(halves.a.map, halves.b.map).refusal, MergeRefusal::several_ways);
}

TEST(MergeMapsOnce, NamesTellARegularHallApart) {
  RandomDraws draws(10);
  std::vector<TrueLandmark3> hall;
  for (double x = 3.0; x < 60.0; x += 6.0)
    for (double y = 2.0; y < 20.0; y += 5.0) hall.push_back({{x, y, 6.5}, static_cast<Identity>(hall.size())});
  const Halves halves = halves_of(hall, draws);
  EXPECT_EQ(merge_maps(halves.a.map, halves.b.map).refusal, MergeRefusal::none);
}

TEST(MergeMapsOnce, ALandmarkThatWasMovedIsCounted) {
  RandomDraws draws(11);
  std::vector<TrueLandmark3> hall = drawn_hall(draws, true);
  const DrawnMap a = drawn_map(between(hall, 0.0, 37.0), kWorldA, draws);
  const auto inside = [](const TrueLandmark3& l) { return l.p_world_m.x() > 26.0 && l.p_world_m.x() < 34.0; };
  std::ranges::find_if(hall, inside)->p_world_m.y() += 3.0;
  const DrawnMap b = drawn_map(between(hall, 23.0, 60.0), kWorldB, draws);
  const MergedMaps merged = merge_maps(a.map, b.map);
  ASSERT_EQ(merged.refusal, MergeRefusal::none);
  EXPECT_EQ(merged.moved, 1U);
  EXPECT_EQ(merged.map.landmarks.size(), hall.size());
}

TEST(MergeMapsOnce, WhatOneWasMadeFromIsNotCountedTwice) {
  RandomDraws draws(12);
  const Halves halves = halves_of(drawn_hall(draws), draws);
  EXPECT_EQ(merge_maps(halves.a.map, halves.a.map).refusal, MergeRefusal::same_origin);
  MapSnapshot looks = halves.b.map;
  looks.names = MapNames::looks;
  EXPECT_EQ(merge_maps(halves.a.map, looks).refusal, MergeRefusal::looks);
  looks.names = MapNames::sensor;
  EXPECT_EQ(merge_maps(halves.a.map, looks).refusal, MergeRefusal::other_names);
}

TEST(MergeMapsOnce, MapsOfNextToNothingAreRefused) {
  RandomDraws draws(13);
  const std::vector<TrueLandmark3> hall = drawn_hall(draws);
  const DrawnMap a = drawn_map(hall, kWorldA, draws);
  DrawnMap b = drawn_map(std::span(hall).first(2), kWorldB, draws);
  EXPECT_EQ(merge_maps(a.map, b.map).refusal, MergeRefusal::no_overlap);
  EXPECT_EQ(merge_maps(b.map, a.map).refusal, MergeRefusal::no_overlap);
  EXPECT_EQ(merge_maps(a.map, MapSnapshot{}).refusal, MergeRefusal::no_overlap);
}

}  // namespace
}  // namespace azimuth::test
