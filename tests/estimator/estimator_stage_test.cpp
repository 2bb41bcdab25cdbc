#include "slam/estimator/estimator_stage.hpp"

#include <gtest/gtest.h>
#include <limits>

#include "tests/estimator/recording_estimator.hpp"
#include "tests/support/stamps.hpp"

namespace azimuth {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A stage with a wait limit of 0.5 s, fed by a robot that drives straight on at 1 m/s.
class StageTest : public testing::Test {
 protected:
  void read(double t_s) { stage_.add(OdometryReading{at_s(t_s), odometry_sequence_++, 0, {t_s, 0.0, 0.0}}); }
  void stand(double t_s, double x_m) {
    stage_.add(OdometryReading{at_s(t_s), odometry_sequence_++, 0, {x_m, 0.0, 0.0}});
  }
  void read_until(double from_s, double to_s) {
    for (int tick = static_cast<int>(std::lround(10.0 * from_s)); tick <= std::lround(10.0 * to_s); ++tick)
      read(0.1 * tick);
  }
  void see(double t_s, std::size_t bearings = 1) {
    BearingSet set{at_s(t_s), set_sequence_++, std::vector<Bearing>(bearings)};
    stage_.add(set);
  }
  using Milliseconds = std::vector<std::int64_t>;
  /// The stamps of the steps that are due now.
  Milliseconds due() {
    Milliseconds stamps_ms;
    while (stage_.advance(estimate_)) stamps_ms.push_back(to_us(estimate_.stamp) / 1000);
    return stamps_ms;
  }
  /// The input counts of one further step at `t_s`, because estimates carry the counts.
  const InputCounts& counts_after(double t_s) {
    read(t_s);
    see(t_s);
    EXPECT_FALSE(due().empty());
    return estimate_.input;
  }

  std::vector<RecordingEstimator::Step> steps_;
  EstimatorStage stage_{std::make_unique<RecordingEstimator>(steps_), Rig{}, StageSettings{0.5}};
  Estimate estimate_;
  std::uint64_t odometry_sequence_ = 0, set_sequence_ = 0;
};

TEST_F(StageTest, NothingInNothingOut) {
  EXPECT_TRUE(due().empty());
  stage_.finish();
  EXPECT_TRUE(due().empty());
  EXPECT_FALSE(stage_.look_ahead(estimate_));
}

TEST_F(StageTest, SetWaitsUntilOdometryReachesItsStamp) {
  read(0.0);
  see(0.25);
  read(0.1);
  read(0.2);
  EXPECT_TRUE(due().empty());
  read(0.3);
  EXPECT_EQ(due(), Milliseconds{250});
  EXPECT_NEAR(estimate_.T_odom_body.x_m, 0.25, 1e-9);  // interpolated
  EXPECT_NEAR(steps_.front().motion.T_start_end.x_m, 0.25, 1e-9);
}

TEST_F(StageTest, StepsComeInTheOrderOfStampsAndAreNumbered) {
  see(0.05);
  see(0.15);
  see(0.25);
  read_until(0.0, 0.2);
  ASSERT_TRUE(stage_.advance(estimate_));
  EXPECT_EQ(estimate_.step, 1u);
  EXPECT_EQ(estimate_.sequence, 1u);
  EXPECT_EQ(estimate_.landmarks.size(), 1u);
  EXPECT_FALSE(estimate_.predicted);
  EXPECT_EQ(due(), Milliseconds{150});
  EXPECT_EQ(estimate_.step, 2u);
  EXPECT_EQ(estimate_.landmarks.size(), 1u);  // of this step, not of all steps
  read(0.3);
  EXPECT_EQ(due(), Milliseconds{250});
  for (const auto& step : steps_) EXPECT_EQ(step.set.bearings.size(), 1u);
}

TEST_F(StageTest, TakesTheStorageOfASetAndGivesBackEmptyStorage) {
  BearingSet set{at_s(0.0), 0, std::vector<Bearing>(7)};
  stage_.add(set);
  EXPECT_TRUE(set.bearings.empty());
  read(0.0);
  EXPECT_EQ(due(), Milliseconds{0});
  EXPECT_EQ(steps_.front().set.bearings.size(), 7u);
}

TEST_F(StageTest, EmptySetIsAStep) {
  read(0.0);
  see(0.0, 0);
  EXPECT_EQ(due(), Milliseconds{0});
}

TEST_F(StageTest, SetInAGapOfOdometryLongerThanTheLimitIsRefused) {
  read_until(0.0, 0.2);
  see(0.25);
  see(0.75);
  see(1.35);
  see(1.4);
  read(1.4);  // 1.15 s after the first set and 0.65 s after the second; the robot's path in between is unknown
  EXPECT_EQ(due(), Milliseconds{1400});
  EXPECT_EQ(estimate_.input.bearings_without_odometry, 3u);
  EXPECT_NEAR(steps_.front().motion.T_start_end.x_m, 1.4, 1e-9);  // no motion is lost
}

TEST_F(StageTest, SetInALongGapThatTheOdometerDoubtsIsRefusedWhereverItLies) {
  const auto read_doubted = [this](double t_s) {
    stage_.add(OdometryReading{at_s(t_s), odometry_sequence_++, 0, {t_s, 0.0, 0.0}, 0.2, 0.05});
  };
  read_until(0.0, 0.2);
  see(0.2);
  see(0.65);  // within the limit before the next reading, but a straight line is only an assumption
  see(0.8);
  read_doubted(0.8);
  see(0.85);
  see(1.1);
  read_doubted(1.2);  // a gap within the limit
  EXPECT_EQ(due(), (Milliseconds{200, 800, 850, 1100}));
  EXPECT_EQ(estimate_.input.bearings_without_odometry, 1u);
}

TEST_F(StageTest, SetInALongGapIsUsedWhereTheRobotStood) {
  read_until(0.0, 0.2);
  see(0.65);
  stand(0.8, 0.2);
  EXPECT_EQ(due(), Milliseconds{650});
}

TEST_F(StageTest, SetInALongGapIsRefusedWhereTheRobotOnlyTurned) {
  read_until(0.0, 0.2);
  see(0.65);
  stage_.add(OdometryReading{at_s(0.8), odometry_sequence_++, 0, {0.2, 0.0, 0.3}});
  EXPECT_EQ(due(), Milliseconds{});
}

TEST_F(StageTest, SetIsGivenUpWhenSetsComeLaterThanTheLimitWithoutOdometry) {
  read(0.0);
  see(0.1);
  see(0.6);
  EXPECT_TRUE(due().empty());
  see(0.7);  // no odometry for more than 0.5 s after 0.1 s: the set at 0.1 s is given up
  EXPECT_TRUE(due().empty());
  stand(0.72, 0.0);
  EXPECT_EQ(due(), (Milliseconds{600, 700}));
  EXPECT_EQ(estimate_.input.bearings_without_odometry, 1u);
}

TEST_F(StageTest, SetFromBeforeTheFirstReadingIsRefusedHoweverClose) {
  see(0.0);
  see(0.6);
  see(0.999);
  EXPECT_TRUE(due().empty());
  read(1.0);
  read(1.1);
  see(1.05);
  EXPECT_EQ(due(), Milliseconds{1050});  // where the moving robot was before the first reading is unknown
  EXPECT_EQ(estimate_.input.bearings_without_odometry, 3u);
  EXPECT_NEAR(steps_[0].motion.T_start_end.x_m, 0.05, 1e-9);
}

TEST_F(StageTest, FinishDecidesByTheReadingsAtHand) {
  read(0.0);
  see(0.0);
  see(0.3);
  EXPECT_EQ(due(), Milliseconds{0});
  stage_.finish();
  EXPECT_TRUE(due().empty());
  read(0.4);
  see(0.4);
  EXPECT_EQ(due(), Milliseconds{400});
  EXPECT_EQ(estimate_.input.bearings_without_odometry, 1u);
}

TEST_F(StageTest, LongSilenceOfOdometryDropsTheOldestSets) {
  for (int i = 0; i < 600; ++i) {
    BearingSet set{stamp_from_us(i), static_cast<std::uint64_t>(i), std::vector<Bearing>(1)};  // within the limit
    stage_.add(set);
  }
  read(0.0);
  read(0.001);
  std::size_t steps = 0;
  while (stage_.advance(estimate_)) ++steps;
  EXPECT_EQ(steps, 512u);
  EXPECT_EQ(estimate_.input.bearings_without_odometry, 600u - steps);
  EXPECT_EQ(to_us(estimate_.stamp), 599);
}

TEST_F(StageTest, OutOfOrderSamplesAreSkippedAndCounted) {
  read_until(0.0, 1.0);
  stage_.add(OdometryReading{at_s(0.5), odometry_sequence_++, 0, {9.0, 9.0, 0.0}});
  stage_.add(OdometryReading{at_s(1.0), odometry_sequence_++, 0, {9.0, 9.0, 0.0}});  // repeated
  see(0.8);
  see(0.4);
  EXPECT_EQ(due(), Milliseconds{800});
  EXPECT_NEAR(estimate_.T_odom_body.x_m, 0.8, 1e-9);
  const InputCounts& counts = counts_after(1.1);
  EXPECT_EQ(counts.odometry_out_of_order, 2u);
  EXPECT_EQ(counts.bearings_out_of_order, 1u);
}

TEST_F(StageTest, MissingSequenceNumbersAreCounted) {
  read(0.0);
  odometry_sequence_ += 3;
  read(0.1);
  see(0.05);
  set_sequence_ += 2;
  see(0.08);
  const InputCounts& counts = counts_after(0.2);
  EXPECT_EQ(counts.odometry_gaps, 3u);
  EXPECT_EQ(counts.bearing_gaps, 2u);
  EXPECT_EQ(counts.bearings_without_odometry, 0u);
}

TEST_F(StageTest, LooksNeverBelongToAnotherBearing) {
  read(0.0);
  BearingSet set{at_s(0.25), set_sequence_++, std::vector<Bearing>(3)};
  set.descriptors.resize(3);
  set.neighbours.resize(3);
  set.bearings[1].azimuth_rad = kNan;
  stage_.add(set);
  read(0.3);
  EXPECT_EQ(due(), Milliseconds{250});
  EXPECT_TRUE(steps_.front().set.bearings.empty());
  EXPECT_TRUE(steps_.front().set.descriptors.empty());
  EXPECT_EQ(estimate_.input.values_not_finite, 3u);
}

TEST_F(StageTest, ValuesThatAreNotFiniteAreLeftOutAndCounted) {
  read(0.0);
  stage_.add(OdometryReading{at_s(0.1), odometry_sequence_++, 0, {kNan, 0.0, 0.0}});
  stage_.add(OdometryReading{at_s(0.2), odometry_sequence_++, 0, {0.0, 0.0, INFINITY}});
  BearingSet set{at_s(0.25), set_sequence_++, std::vector<Bearing>(3)};
  set.bearings[0].azimuth_rad = kNan;
  set.bearings[1].azimuth_rad = 0.5;
  set.bearings[2].azimuth_rad = INFINITY;
  stage_.add(set);
  read(0.3);
  EXPECT_EQ(due(), Milliseconds{250});
  ASSERT_EQ(steps_.front().set.bearings.size(), 1u);
  EXPECT_EQ(steps_.front().set.bearings.front().azimuth_rad, 0.5);
  EXPECT_EQ(estimate_.input.values_not_finite, 4u);
  EXPECT_NEAR(estimate_.T_odom_body.x_m, 0.25, 1e-9);
}

TEST_F(StageTest, BadOdometryIsNotCountedAsLostToo) {
  read(0.0);
  stage_.add(OdometryReading{at_s(0.1), odometry_sequence_++, 0, {kNan, 0.0, 0.0}});
  read(0.2);
  EXPECT_EQ(counts_after(0.3).odometry_gaps, 0u);
}

TEST_F(StageTest, LookAheadGivesThePoseOfTheNewestReading) {
  read_until(0.0, 0.3);
  see(0.2);
  EXPECT_EQ(due(), Milliseconds{200});
  read(0.4);
  ASSERT_TRUE(stage_.look_ahead(estimate_));
  EXPECT_TRUE(estimate_.predicted);
  EXPECT_EQ(estimate_.stamp, at_s(0.4));
  EXPECT_NEAR(estimate_.T_map_body.x_m, 0.4, 1e-9);
  EXPECT_NEAR(estimate_.T_odom_body.x_m, 0.4, 1e-9);
  EXPECT_TRUE(estimate_.landmarks.empty());
  EXPECT_EQ(estimate_.step, 1u);
  EXPECT_FALSE(stage_.look_ahead(estimate_)) << "nothing new since";
  read(0.5);
  EXPECT_TRUE(stage_.look_ahead(estimate_));
}

TEST_F(StageTest, LookAheadHasNothingToSayWhereTheStepAlreadyIs) {
  read_until(0.0, 0.3);
  see(0.3);
  EXPECT_EQ(due(), Milliseconds{300});
  EXPECT_FALSE(stage_.look_ahead(estimate_));
}

}  // namespace
}  // namespace azimuth
