#include "settings/sample_sentence.hpp"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace azimuth {
namespace {

/// Every trouble has a one-line text, with a key or column to check if there is one.
TEST(Sentence, OfEveryTroubleIsOne) {
  for (int i = 1; i <= static_cast<int>(SampleTrouble::names_repeated); ++i) {
    SampleFinding finding;
    finding.trouble = static_cast<SampleTrouble>(i);
    finding.odometry.count = finding.sets.count = 2;
    finding.image = ImageTrouble::dark;
    const std::string said = sentence(finding);
    EXPECT_GT(said.size(), 20U) << to_string(finding.trouble);
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    EXPECT_NE(to_string(finding.trouble), "?");
  }
  EXPECT_EQ(sentence(SampleFinding{}), "");
}

TEST(Sentence, HasTheNumbers) {
  SampleFinding finding;
  finding.trouble = SampleTrouble::apart_in_time;
  finding.odometry = {Stamp{}, stamp_from_us(36'000'000), 100};
  finding.sets = {stamp_from_us(1'000'000'000), stamp_from_us(1'036'000'000), 50};
  EXPECT_EQ(sentence(finding),
            "bearings are not of the odometry's time (odometry 0 to 36 s, bearings 1000 to 1036 s): are the stamps of "
            "two clocks, or in two units? t_s is in seconds, utime in microseconds");
}

TEST(Sentence, SaysWhichStampsAreInAnotherUnit) {
  const StampSpan seconds{Stamp{}, stamp_from_us(36'000'000), 100};
  const StampSpan milliseconds{stamp_from_us(1'000'000'000), stamp_from_us(36'000'000'000), 50};
  EXPECT_EQ(apart_sentence(seconds, milliseconds, "bearings"),
            "bearings' stamps seem to be in milliseconds (odometry 0 to 36 s, bearings 1000 to 36000 s): t_s is in "
            "seconds, utime in microseconds; azimuth import takes t_s=COLUMN[ms]");
  EXPECT_EQ(apart_sentence(milliseconds, seconds, "images"),
            "odometry's stamps seem to be in milliseconds (odometry 1000 to 36000 s, images 0 to 36 s): t_s is in "
            "seconds, utime in microseconds; azimuth import takes t_s=COLUMN[ms]");
  const StampSpan epoch{stamp_from_us(1'700'000'000'000'000), stamp_from_us(1'700'000'036'000'000), 100};
  const StampSpan epoch_us{stamp_from_us(1'700'000'000'000'000'000), stamp_from_us(1'700'000'036'000'000'000), 100};
  EXPECT_NE(apart_sentence(epoch, epoch_us, "bearings").find("bearings' stamps seem to be in milliseconds"),
            std::string::npos);
}

TEST(RestartSentence, SaysWhenAndHowFar) {
  std::vector<OdometryReading> readings;
  for (int i = 0; i < 10; ++i)
    readings.push_back({.stamp = stamp_from_us(1'000'000 * std::int64_t{100 + i}), .T_odom_body = {1.0 * i, 0.0, 0.0}});
  EXPECT_EQ(restart_sentence(readings), "");
  readings[5].T_odom_body = {};
  readings[5].sigma_gap_m = 0.05;
  readings[5].sigma_gap_rad = 0.1;
  for (std::size_t i = 5; i < readings.size(); ++i) readings[i].origin = 1;
  EXPECT_EQ(restart_sentence(readings),
            "odometry begins anew 5.0 s after its first reading, 4 m and 0 degrees from where it was: it goes on from "
            "there, and the way meanwhile is known to 0.05 m and 5.7 degrees");
  readings.back().origin = 2;
  EXPECT_EQ(restart_sentence(readings).find("odometry begins anew 2 times, first 5.0 s after"), 0u);
}

}  // namespace
}  // namespace azimuth
