// The status line on a terminal.

#include "daemon/supervise/status_display.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "daemon/publish/status.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(OneLine, IsCutToTheTerminalsWidth) {
  EXPECT_EQ(one_line_of("tracking", 80), "tracking");
  EXPECT_EQ(one_line_of("tracking", 9), "tracking") << "the last column stays empty";
  EXPECT_EQ(one_line_of("tracking", 8), "trac...");
  EXPECT_EQ(one_line_of("tracking", 3), "tr");
  EXPECT_EQ(one_line_of("tracking", 1), "");
  EXPECT_EQ(one_line_of("tracking", 0), "tracking") << "a terminal that does not tell its width";
}

TEST(OneLine, CutsNoCharacterInTwo) {
  EXPECT_EQ(one_line_of("Größe µm", 9), "Größe µm") << "columns are not bytes";
  EXPECT_EQ(one_line_of("Größe µm", 8), "Größ...");
}

TEST(OneLine, NeitherWrapsNorMovesTheCursor) { EXPECT_EQ(one_line_of("a\nb\r\x1b[2Jc", 80), "a\\nb\\r\\x1b[2Jc"); }

TEST(DurationText, HasTwoUnits) {
  EXPECT_EQ(duration_text(0s), "0 s");
  EXPECT_EQ(duration_text(59s), "59 s");
  EXPECT_EQ(duration_text(185s), "3 min 05 s");
  EXPECT_EQ(duration_text(2h + 14min + 59s), "2 h 14 min");
  EXPECT_EQ(duration_text(123h), "5 d 03 h");
}

TEST(StatusLine, BeginsWithTheUptimeAndWhatMattersMost) {
  Status status;
  EXPECT_THAT(status_line(status, 3s), StartsWith("up 3 s  no estimate yet"));
  status.any_estimate = true;
  status.estimate.stamp = Stamp{duration_from_seconds(1'800'000'000.0)};
  status.estimate.health = Health::degraded;
  status.estimate.reason = "no bearings";
  status.landmarks = 7;
  status.camera = {.text = "silent"};
  const std::string line = status_line(status, 75s);
  EXPECT_THAT(line, StartsWith("up 1 min 15 s  degraded: no images  camera: silent  x 0.00"));
  EXPECT_THAT(line, HasSubstr("7 landmarks"));
  EXPECT_THAT(line, Not(HasSubstr("1800000000"))) << "nobody reads seconds since 1970";
  EXPECT_THAT(one_line_of(line, 80), HasSubstr("camera: silent"));
  EXPECT_THAT(pose_line(status.estimate), StartsWith("t 1800000000.000 s  degraded: no bearings  x 0.00"));
}

}  // namespace
}  // namespace azimuth
