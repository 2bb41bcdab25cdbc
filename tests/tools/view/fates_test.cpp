#include <gmock/gmock.h>
#include <limits>

#include "tools/view/shown_bearings.hpp"

namespace azimuth::test {
namespace {

BearingSet bearings_at(std::initializer_list<double> azimuths_rad) {
  BearingSet set;
  for (const double azimuth_rad : azimuths_rad) set.bearings.push_back({.azimuth_rad = azimuth_rad});
  return set;
}

sightings_t used(std::initializer_list<std::pair<std::int64_t, double>> sightings) {
  sightings_t message{};
  for (const auto& [landmark, azimuth_rad] : sightings) {
    sighting_t sighting{};
    sighting.landmark_id = landmark;
    sighting.azimuth_rad = azimuth_rad;
    sighting.elevation_rad = std::numeric_limits<double>::quiet_NaN();
    message.sightings.push_back(sighting);
  }
  message.n = static_cast<std::int32_t>(message.sightings.size());
  return message;
}

TEST(Fates, ABearingAmongTheSightingsWasUsed) {
  const auto fates = fates_of(bearings_at({0.1, 0.2}), used({{7, 0.2}}), std::nullopt, false);
  EXPECT_EQ(fates[1].word, "used");
  EXPECT_EQ(fates[1].landmark, 7);
  EXPECT_EQ(fates[0].word, "unknown") << "nobody said";
}

TEST(Fates, AnglesThatTurnTheOtherWayAreTheSame) {
  const auto fates = fates_of(bearings_at({0.2, -0.2}), used({{7, 0.2}}), std::nullopt, true);
  EXPECT_EQ(fates[0].word, "unknown");
  EXPECT_EQ(fates[1].word, "used");
}

TEST(Fates, OfTwoLampsOneBehindTheOtherTheElevationTells) {
  BearingSet set = bearings_at({0.2, 0.2});
  set.bearings[0].elevation_rad = 1.0;
  set.bearings[1].elevation_rad = 1.2;
  sightings_t sightings = used({{7, 0.2}});
  sightings.sightings[0].elevation_rad = 1.2;
  const auto fates = fates_of(set, sightings, std::nullopt, false);
  EXPECT_EQ(fates[0].word, "unknown");
  EXPECT_EQ(fates[1].word, "used");
}

TEST(Fates, OneSightingIsOfOneBearing) {
  const auto fates = fates_of(bearings_at({0.2, 0.2}), used({{7, 0.2}}), std::nullopt, false);
  EXPECT_EQ(fates[0].word, "used");
  EXPECT_EQ(fates[1].word, "unknown");
}

TEST(Fates, OneNumberThatAccountsForAllOthersIsTheirFate) {
  const auto fates = fates_of(bearings_at({0.1, 0.2, 0.3}), used({{7, 0.2}}), ImageCounts{.rejected = 2}, false);
  EXPECT_EQ(fates[0].word, "refused");
  EXPECT_EQ(fates[1].word, "used");
  EXPECT_EQ(fates[2].word, "refused");
  EXPECT_EQ(fates_of(bearings_at({0.1}), used({}), ImageCounts{.created = 1}, false)[0].word, "new");
}

TEST(Fates, NeverInvented) {
  const auto word = [](const ImageCounts& counts) {
    return fates_of(bearings_at({0.1, 0.2}), used({}), counts, false)[0].word;
  };
  EXPECT_EQ(word({.rejected = 1}), "unknown") << "of the other nothing is known";
  EXPECT_EQ(word({.rejected = 1, .created = 1}), "unknown") << "which is which?";
  EXPECT_EQ(word({}), "unknown");
}

TEST(Fates, CountsAreThoseOfTwoStepsOneAfterTheOther) {
  sightings_t before{}, now{};
  before.step = 4;
  before.rejected = 10;
  now.step = 5;
  now.rejected = 12;
  ASSERT_TRUE(counts_of(&before, now));
  EXPECT_EQ(counts_of(&before, now)->rejected, 2);
  now.step = 6;
  EXPECT_FALSE(counts_of(&before, now));
  EXPECT_FALSE(counts_of(nullptr, now));
}

}  // namespace
}  // namespace azimuth::test
