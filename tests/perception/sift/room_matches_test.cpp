// Compares the matching of Azimuth's features with OpenCV's SIFT, in rooms that served for no tuning.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/feature_matching.hpp"

namespace azimuth {
namespace {

constexpr std::uint64_t kFirstSeed = 11;  // lower seeds serve for tuning
constexpr int kRooms = 5, kPairs = 24;

test::MatchScore scored(const std::vector<test::RoomPairs>& rooms, const test::FeatureMethod& method) {
  const test::MatchScore score = test::match_score(rooms, method);
  fmt::print("{}: {} of {} findable of {} features, recall {:.3f} up to a ratio of {:.2f}\n", method.name, score.right,
             score.findable, score.features, score.recall(), score.ratio);
  return score;
}

TEST(RoomMatches, AreFarMoreThanOfOpenCvsSift) {
  std::vector<test::RoomPairs> rooms;
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kRooms; ++seed)
    rooms.push_back(test::room_pairs(seed, {.count = kPairs}));
  const CameraRig& rig = rooms.front().rig;
  const test::MatchScore theirs = scored(rooms, test::opencv_features(rig, "SIFT", SiftSettings{}.target_count));
  const test::MatchScore ours = scored(rooms, test::azimuth_features(rig, SiftSettings{}, "Azimuth"));
  EXPECT_GE(ours.recall(), 1.3 * theirs.recall());
  EXPECT_GE(ours.right, theirs.right);
}

}  // namespace
}  // namespace azimuth
