#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "drivers/picture/picture.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

constexpr double kRadius_px = 200.0;

/// Gaps between the ends of neighbouring names round the rim, in pixels.
std::vector<double> gaps_px(const std::vector<RimNames::Name>& names) {
  std::vector<double> gaps;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const RimNames::Name &one = names[i], &next = names[(i + 1) % names.size()];
    const double apart_rad = next.placed_rad - one.placed_rad + (i + 1 == names.size() ? 2.0 * kPi : 0.0);
    const double long_px = 0.5 * (Canvas::label_size_px(one.text).norm() + Canvas::label_size_px(next.text).norm());
    gaps.push_back(apart_rad * kRadius_px - long_px);
  }
  return gaps;
}

RimNames names_at(const std::vector<double>& azimuths_rad) {
  RimNames names;
  for (std::size_t i = 0; i < azimuths_rad.size(); ++i) names.add(azimuths_rad[i], std::to_string(100 + i), {});
  return names;
}

TEST(RimNames, WithRoomStandWhereTheyBelong) {
  RimNames names = names_at({-2.0, 0.0, 1.0, 3.0});
  for (const RimNames::Name& name : names.placed(kRadius_px))
    EXPECT_NEAR(wrap(name.placed_rad - name.azimuth_rad), 0.0, 1e-12) << name.text;
}

TEST(RimNames, ThatWouldTouchMakeRoomAlike) {
  RimNames names = names_at({0.02, -0.02});
  const std::vector<RimNames::Name>& placed = names.placed(kRadius_px);
  ASSERT_EQ(placed.size(), 2u);
  EXPECT_NEAR(placed[0].placed_rad, -placed[1].placed_rad, 1e-12);
  EXPECT_GT(gaps_px(placed)[0], 0.0);
}

TEST(RimNames, OfACrowdStandApartAllRoundTheRim) {
  std::vector<double> azimuths_rad;
  for (int i = 0; i < 12; ++i) azimuths_rad.push_back(kPi - 0.1 + 0.01 * i);  // across the seam behind the robot
  for (int i = 0; i < 12; ++i) azimuths_rad.push_back(0.5 + 0.04 * i);
  RimNames names = names_at(azimuths_rad);
  const std::vector<RimNames::Name>& placed = names.placed(kRadius_px);
  ASSERT_EQ(placed.size(), 24u);
  EXPECT_GT(std::ranges::min(gaps_px(placed)), 0.0);
}

TEST(RimNames, OfMoreThanHaveRoomShareIt) {
  std::vector<double> azimuths_rad;
  for (int i = 0; i < 200; ++i) azimuths_rad.push_back(0.001 * i);
  RimNames names = names_at(azimuths_rad);
  const std::vector<RimNames::Name>& placed = names.placed(kRadius_px);
  EXPECT_NEAR(placed.back().placed_rad - placed.front().placed_rad, 2.0 * kPi * 199 / 200, 1e-9);
  EXPECT_TRUE(RimNames().placed(kRadius_px).empty());
}

}  // namespace
}  // namespace azimuth
