#include "tools/plot/label_space.hpp"

#include <array>
#include <gtest/gtest.h>

namespace azimuth {
namespace {

const Box kFrame{{100.0, 50.0}, {500.0, 350.0}};
const Eigen::Vector2d kSize{40.0, 14.0};
constexpr std::array kNear{12.0};

bool overlap(const Box& a, const Box& b) {
  return (a.low.array() < b.high.array()).all() && (b.low.array() < a.high.array()).all();
}

bool within(const Box& inner, const Box& outer) { return outer.contains(inner.low) && outer.contains(inner.high); }

TEST(LabelSpace, PutsALabelToTheRightWhereThereIsRoom) {
  LabelSpace space(kFrame);
  const auto box = space.place({300.0, 200.0}, kSize, kNear);
  ASSERT_TRUE(box);
  EXPECT_EQ(box->low, Eigen::Vector2d(312.0, 193.0));
  EXPECT_EQ(box->high - box->low, kSize);
}

TEST(LabelSpace, StaysInsideTheFrame) {
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(101.0, 51.0), Eigen::Vector2d(499.0, 51.0),
                                        Eigen::Vector2d(499.0, 349.0), Eigen::Vector2d(101.0, 349.0)}) {
    LabelSpace space(kFrame);
    const auto box = space.place(corner, kSize, kNear);
    ASSERT_TRUE(box) << corner.transpose();
    EXPECT_TRUE(within(*box, kFrame));
  }
  EXPECT_FALSE(LabelSpace(kFrame).place({700.0, 200.0}, kSize, kNear)) << "a point outside has no label";
  EXPECT_FALSE(LabelSpace(kFrame).place({300.0, 200.0}, {1000.0, 14.0}, kNear)) << "too long for the frame";
}

TEST(LabelSpace, LabelsNeverOverlapAndACrowdGetsFew) {
  LabelSpace space(kFrame);
  std::vector<Box> labels;
  int wanted = 0;
  for (double x = 110.0; x < 500.0; x += 10.0)
    for (double y = 60.0; y < 350.0; y += 10.0, ++wanted)
      if (const auto box = space.place({x, y}, kSize, kNear)) labels.push_back(*box);
  EXPECT_GT(labels.size(), 50U);
  EXPECT_LT(static_cast<int>(labels.size()), wanted / 3);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    EXPECT_TRUE(within(labels[i], kFrame));
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(labels[i], labels[j])) << i << " and " << j;
  }
}

TEST(LabelSpace, TouchesNothingThatIsTaken) {
  LabelSpace space(kFrame);
  const Box marker{{318.0, 190.0}, {330.0, 210.0}};
  space.take(marker);
  space.take(PlotLine{{200.0, 180.0}, {400.0, 180.0}});
  const auto box = space.place({300.0, 200.0}, kSize, kNear);
  ASSERT_TRUE(box);
  EXPECT_FALSE(overlap(*box, marker));
  EXPECT_FALSE(box->low.y() < 180.0 && box->high.y() > 180.0) << "it is written across the line";
}

TEST(LabelSpace, AvoidsAPathWhereItCan) {
  LabelSpace space(kFrame);
  space.avoid(PlotLine{{330.0, 60.0}, {330.0, 340.0}});
  const auto free = space.place({300.0, 200.0}, kSize, kNear);
  ASSERT_TRUE(free);
  EXPECT_LT(free->high.x(), 300.0) << "to the left of its point";
  for (double x = 110.0; x < 500.0; x += 4.0) space.avoid(PlotLine{{x, 60.0}, {x, 340.0}});
  EXPECT_TRUE(space.place({300.0, 120.0}, kSize, kNear)) << "on a path rather than nowhere";
}

TEST(LabelSpace, StandsNearestToItsOwnPoint) {
  const Eigen::Vector2d own{300.0, 200.0}, neighbour{345.0, 200.0};
  LabelSpace space(kFrame);
  space.add_point(own);
  space.add_point(neighbour);
  const auto box = space.place(own, {30.0, 14.0}, kNear);
  ASSERT_TRUE(box);
  EXPECT_LT(box->high.x(), 330.0) << "to the right it would be read as the neighbour's";
}

TEST(LabelSpace, GoesFartherOutWhenTheNearIsTaken) {
  LabelSpace space(kFrame);
  space.take(Box{{270.0, 180.0}, {330.0, 220.0}});
  EXPECT_FALSE(space.place({300.0, 200.0}, kSize, kNear));
  EXPECT_TRUE(space.place({300.0, 200.0}, kSize, std::array{12.0, 40.0}));
}

}  // namespace
}  // namespace azimuth
