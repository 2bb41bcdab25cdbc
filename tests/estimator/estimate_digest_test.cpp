#include "slam/estimator/estimate_digest.hpp"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace azimuth {
namespace {

Estimate some_estimate() {
  Estimate estimate;
  estimate.stamp = stamp_from_us(1234567);
  estimate.T_map_body = {1.0, 2.0, 0.3};
  estimate.pose_covariance = Eigen::Vector3d(0.01, 0.02, 0.003).asDiagonal();
  estimate.landmarks.resize(2);
  estimate.landmarks[0].id = 0;
  estimate.landmarks[1].id = 1;
  estimate.landmarks[1].p_map_landmark_m = {4.0, 5.0};
  return estimate;
}

std::uint64_t digest_of(std::initializer_list<Estimate> estimates) {
  EstimateDigest digest;
  for (const Estimate& estimate : estimates) digest.add(estimate);
  return digest.value();
}

TEST(EstimateDigest, IsTheSameForTheSameEstimates) {
  EXPECT_EQ(digest_of({some_estimate()}), digest_of({some_estimate()}));
  EXPECT_NE(digest_of({some_estimate()}), digest_of({some_estimate(), some_estimate()}));
  EXPECT_NE(digest_of({}), digest_of({some_estimate()}));
}

TEST(EstimateDigest, NoticesTheLastBitOfEverythingThatCounts) {
  const auto next = [](double& value) { value = std::nextafter(value, 100.0); };
  const std::function<void(Estimate&)> changes[]{
      [](Estimate& e) { e.stamp += Duration{1}; },
      [&](Estimate& e) { next(e.T_map_body.x_m); },
      [&](Estimate& e) { next(e.T_map_body.heading_rad); },
      [&](Estimate& e) { next(e.pose_covariance(1, 0)); },
      [&](Estimate& e) { next(e.pose_covariance(2, 2)); },
      [](Estimate& e) { e.landmarks.pop_back(); },
      [](Estimate& e) { e.landmarks[1].id = 7; },
      [](Estimate& e) { e.landmarks[0].identity = 7; },
      [&](Estimate& e) { next(e.landmarks[1].p_map_landmark_m.y()); },
      [&](Estimate& e) { next(e.landmarks[0].covariance_m2(0, 1)); },
      [](Estimate& e) { std::swap(e.landmarks[0], e.landmarks[1]); },
      [](Estimate& e) { e.T_map_body.y_m *= -1.0; },
  };
  const std::uint64_t original = digest_of({some_estimate()});
  for (std::size_t i = 0; i < std::size(changes); ++i) {
    Estimate changed = some_estimate();
    changes[i](changed);
    EXPECT_NE(digest_of({changed}), original) << "change " << i;
  }
}

TEST(EstimateDigest, KnowsTheOrder) {
  Estimate other = some_estimate();
  other.T_map_body.x_m = 9.0;
  EXPECT_NE(digest_of({some_estimate(), other}), digest_of({other, some_estimate()}));
}

TEST(EstimateDigest, LeavesOutPredictionsAndWhatTheStageCounts) {
  Estimate prediction = some_estimate();
  prediction.predicted = true;
  EXPECT_EQ(digest_of({some_estimate(), prediction}), digest_of({some_estimate()}));
  Estimate later = some_estimate();
  later.sequence = 99;  // the sequence number counts predictions too
  EXPECT_EQ(digest_of({later}), digest_of({some_estimate()}));
}

TEST(EstimateDigest, IsWrittenAsSixteenDigits) {
  EXPECT_EQ(digest_text(0), "0000000000000000");
  EXPECT_EQ(digest_text(0x0123456789abcdefULL), "0123456789abcdef");
  EXPECT_EQ(digest_text(~0ULL), "ffffffffffffffff");
}

}  // namespace
}  // namespace azimuth
