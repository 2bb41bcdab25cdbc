#include "tools/view/trail.hpp"

#include <gmock/gmock.h>
#include <limits>

namespace azimuth::test {
namespace {

constexpr double kEver = -std::numeric_limits<double>::infinity();

TrailPoint at(double t_s, double x_m) { return {.t_s = t_s, .T_map_body = {x_m, 0.0, 0.0}, .T_odom_body = {}}; }

TEST(Trail, KeepsPointsThatAreApart) {
  Trail trail(100);
  for (int i = 0; i < 10; ++i) trail.add(at(0.1 * i, 0.1 * i));
  EXPECT_EQ(trail.points().size(), 10U);
}

TEST(Trail, AStandingRobotIsTwoPointsOfWhichTheLastIsTheNewest) {
  Trail trail(100);
  for (int i = 0; i < 9; ++i) trail.add(at(0.1 * i, 0.0));
  EXPECT_EQ(trail.points().size(), 2U);
  EXPECT_DOUBLE_EQ(trail.points().back().t_s, 0.8);
}

TEST(Trail, IsBoundedAndKeepsBothEnds) {
  Trail trail(1000);
  for (int i = 0; i < 100'000; ++i) {
    trail.add(at(i, i));
    ASSERT_LE(trail.points().size(), 1000U);
  }
  EXPECT_DOUBLE_EQ(trail.points().front().t_s, 0.0);
  EXPECT_DOUBLE_EQ(trail.points().back().t_s, 99'999.0);
  EXPECT_GT(trail.points().size(), 300U) << "not thinner than need be";
}

TEST(Trail, ALateStepGoesWhereItBelongs) {
  Trail trail(100);
  trail.add(at(1.0, 1.0));
  trail.add(at(3.0, 3.0));
  trail.add(at(2.0, 2.0));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(trail.points()[i].t_s, 1.0 + static_cast<double>(i));
}

TEST(Trail, GivesWhatIsNewerPieceByPiece) {
  Trail trail(100);
  for (int i = 0; i < 10; ++i) trail.add(at(i, i));
  EXPECT_EQ(trail.after(kEver, 4).size(), 4U);
  EXPECT_DOUBLE_EQ(trail.after(3.0, 4).front().t_s, 4.0);
  EXPECT_EQ(trail.after(7.0, 4).size(), 2U);
  EXPECT_TRUE(trail.after(9.0, 4).empty());
}

TEST(Trail, BeginsAnewAsFineAsAtFirst) {
  Trail trail(10);
  for (int i = 0; i < 1000; ++i) trail.add(at(i, i));
  trail.clear();
  EXPECT_TRUE(trail.points().empty());
  for (int i = 0; i < 5; ++i) trail.add(at(0.1 * i, 0.02 * i));
  EXPECT_EQ(trail.points().size(), 5U);
}

}  // namespace
}  // namespace azimuth::test
