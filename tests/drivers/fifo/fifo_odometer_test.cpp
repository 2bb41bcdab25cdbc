// Odometry from another program, line by line, while that program starts and stops.

#include "drivers/fifo/fifo_odometer.hpp"

#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>
#include <vector>

#include "slam/geometry/angle.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

TEST(FifoLine, HoldsStampAndPose) {
  const auto reading = parse_fifo_line("12.500001,-1.25,3e-3,0.5");
  ASSERT_TRUE(reading);
  EXPECT_EQ(to_us(reading->stamp), 12'500'001);
  EXPECT_EQ(reading->T_odom_body, (Pose2{-1.25, 0.003, 0.5}));
}

TEST(FifoLine, MayEndAsOnWindows) {
  const auto reading = parse_fifo_line("12.5,1,2,0.5\r");
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->T_odom_body, (Pose2{1.0, 2.0, 0.5}));
  EXPECT_FALSE(parse_fifo_line("12.5,1,2,0.5\r\r"));
}

TEST(FifoLine, HeadingsThatCountTurnsAreBroughtIntoOne) {
  EXPECT_NEAR(parse_fifo_line("1,0,0,7")->T_odom_body.heading_rad, 7.0 - 2.0 * kPi, 1e-12);
}

TEST(FifoLine, WhatIsNoneIsRefused) {
  for (const char* wrong : {"", "1", "1,2,3", "1,2,3,", "1,2,3,4,5", "1,2,3,4,", ",1,2,3", "1,2,3,x", "1,2,3,4 ",
                            "1;2;3;4", "stamp_s,x_m,y_m,heading_rad", "nan,0,0,0", "1,nan,0,0", "1,0,inf,0",
                            "1e300,0,0,0", "1,1e300,0,0", "1,0,0,1e300"})
    EXPECT_FALSE(parse_fifo_line(wrong)) << wrong;
  EXPECT_FALSE(parse_fifo_line("1,2,3,4" + std::string(200, '0')));
}

class FifoOdometerTest : public testing::Test {
 protected:
  static constexpr Duration kEpoch = 1000s;
  using Writer = UniqueFd;

  Writer writer() const { return Writer(::open(settings_.path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC)); }
  static void write(const Writer& writer, const std::string& text) {
    ASSERT_EQ(::write(writer.get(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  /// A line for a reading taken `age` ago.
  std::string line(Duration age, double x_m = 0.0) const {
    const auto stamp = std::chrono::duration_cast<Duration>(now_.time_since_epoch()) - age;
    return std::to_string(to_seconds(stamp)) + ',' + std::to_string(x_m) + ",0,0\n";
  }
  std::vector<OdometryReading> turn() {
    odometer_.turn(now_);
    std::vector<OdometryReading> readings;
    for (OdometryReading reading; odometer_.take(reading);) readings.push_back(reading);
    return readings;
  }
  /// Whether poll() would return at once.
  bool wakes() const {
    pollfd descriptor{odometer_.descriptor(), POLLIN, 0};
    return ::poll(&descriptor, 1, 0) > 0;
  }

  test::TemporaryFolder folder_;
  FifoSettings settings_{.path = folder_ / "odometry"};
  FifoOdometer odometer_{settings_, kEpoch};
  FifoOdometer::Clock::time_point now_{500s};
};

TEST_F(FifoOdometerTest, IsMadeForOthersToWriteTo) {
  turn();
  struct stat status {};
  ASSERT_EQ(::stat(settings_.path.c_str(), &status), 0);
  EXPECT_TRUE(S_ISFIFO(status.st_mode));
  EXPECT_EQ(status.st_mode & 0777, 0660U);
  EXPECT_EQ(odometer_.state().trouble, "");
}

TEST_F(FifoOdometerTest, LinesBecomeReadings) {
  turn();
  const Writer robot = writer();
  write(robot, line(200ms, 1.0) + line(100ms, 2.0));
  EXPECT_TRUE(wakes());
  const auto readings = turn();
  ASSERT_EQ(readings.size(), 2u);
  EXPECT_EQ(readings[0].stamp, Stamp{kEpoch + 500s - 200ms});
  EXPECT_EQ(readings[1].T_odom_body.x_m, 2.0);
  EXPECT_EQ(readings[1].sequence, readings[0].sequence + 1);
  EXPECT_EQ(readings[1].origin, readings[0].origin);
  EXPECT_EQ(odometer_.state().refused, 0u);
}

TEST_F(FifoOdometerTest, ALineMayComeInPieces) {
  turn();
  const Writer robot = writer();
  const std::string whole = line(0ms, 1.5);
  write(robot, whole.substr(0, 7));
  EXPECT_TRUE(turn().empty());
  write(robot, whole.substr(7));
  EXPECT_EQ(turn().size(), 1u);
}

TEST_F(FifoOdometerTest, AWriterThatComesAnewBeginsAnOrigin) {
  turn();
  std::optional<Writer> robot = writer();
  write(*robot, line(300ms, 5.0) + "0.1,cut sho");
  const auto before = turn();
  robot.reset();
  turn();
  EXPECT_FALSE(wakes()) << "a writer that is gone must not keep the thread awake";
  robot = writer();
  write(*robot, line(100ms, 0.0) + line(50ms, 0.1));
  const auto after = turn();
  ASSERT_EQ(before.size(), 1u);
  ASSERT_EQ(after.size(), 2u) << "what the one before left of a line is not taken for its beginning";
  EXPECT_NE(after[0].origin, before[0].origin);
  EXPECT_EQ(after[0].origin, after[1].origin);
  EXPECT_EQ(after[0].sequence, before[0].sequence + 1);
}

TEST_F(FifoOdometerTest, AWriterNeverFindsNobody) {
  turn();
  for (int i = 0; i < 3; ++i) {
    const Writer robot = writer();
    ASSERT_TRUE(robot) << "ENXIO: no reader";
    turn();
  }
}

TEST_F(FifoOdometerTest, LinesOfNoUseAreRefusedAndSayWhy) {
  turn();
  const Writer robot = writer();
  write(robot, "stamp_s,x_m,y_m,heading_rad\n");
  EXPECT_TRUE(turn().empty());
  EXPECT_EQ(odometer_.state().refusal, "not stamp_s,x_m,y_m,heading_rad");
  for (const Duration age : {Duration{1100ms}, Duration{-20ms}, Duration{-1'700'000'000s}}) {
    write(robot, line(age));
    EXPECT_TRUE(turn().empty());
    EXPECT_EQ(odometer_.state().refusal, "not stamped by CLOCK_MONOTONIC");
  }
  write(robot, line(100ms) + line(100ms) + line(200ms));
  EXPECT_EQ(turn().size(), 1u);
  EXPECT_EQ(odometer_.state().refusal, "out of order");
  EXPECT_EQ(odometer_.state().refused, 6u);
}

TEST_F(FifoOdometerTest, AnEndlessLineIsRefusedOnce) {
  turn();
  const Writer robot = writer();
  for (int i = 0; i < 5; ++i) {
    write(robot, std::string(4000, '1'));
    EXPECT_TRUE(turn().empty());
  }
  write(robot, "\n" + line(0ms));
  EXPECT_EQ(turn().size(), 1u);
  EXPECT_EQ(odometer_.state().refused, 1u);
}

TEST_F(FifoOdometerTest, WhatIsNoFifoIsTroubleUntilItIsGone) {
  std::ofstream(settings_.path) << "12,0,0,0\n";
  EXPECT_TRUE(turn().empty());
  EXPECT_EQ(odometer_.state().trouble, settings_.path + ": is no FIFO");
  EXPECT_EQ(odometer_.descriptor(), -1);
  std::filesystem::remove(settings_.path);
  now_ += odometer_.due_in(now_);
  turn();
  EXPECT_NE(odometer_.descriptor(), -1);
  write(writer(), line(0ms));
  turn();
  EXPECT_EQ(odometer_.state().trouble, "");
}

TEST_F(FifoOdometerTest, SaysHowItIsAndTellsEachChangeOnce) {
  const auto told = [this] {
    std::vector<std::string> events;
    for (std::string event; odometer_.take_event(event);) events.push_back(event);
    return events;
  };
  const std::string silent = settings_.path + ": no odometry", running = "odometry comes from " + settings_.path;
  turn();
  EXPECT_EQ(odometer_.state().connection, Connection::starting);
  EXPECT_EQ(odometer_.due_in(now_), 1s);
  now_ += 1s;
  turn();
  EXPECT_EQ(odometer_.state().connection, Connection::silent) << "nobody writes";
  EXPECT_EQ(told(), std::vector<std::string>{silent});
  const Writer robot = writer();
  for (int i = 0; i < 3; ++i) {
    now_ += 999ms;
    write(robot, line(0ms));
    turn();
    EXPECT_EQ(odometer_.state().connection, Connection::running);
  }
  EXPECT_EQ(told(), std::vector<std::string>{running});
  now_ += 1s;
  turn();
  turn();
  EXPECT_EQ(odometer_.state().connection, Connection::silent);
  EXPECT_EQ(told(), std::vector<std::string>{silent});
}

TEST_F(FifoOdometerTest, AFolderThatIsNotThereIsTrouble) {
  FifoOdometer nowhere({.path = folder_ / "none/odometry"}, kEpoch);
  nowhere.turn(now_);
  EXPECT_EQ(nowhere.state().trouble, (folder_ / "none/odometry").string() + ": No such file or directory");
}

TEST_F(FifoOdometerTest, OriginsGoOnAfterThoseOfTheProcessBefore) {
  odometer_.follow(41);
  turn();
  const Writer robot = writer();
  write(robot, line(0ms));
  const auto readings = turn();
  ASSERT_EQ(readings.size(), 1u);
  EXPECT_EQ(readings[0].origin, 42u);
}

}  // namespace
}  // namespace azimuth
