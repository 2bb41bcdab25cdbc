#include "settings/sample_sentence.hpp"

#include <gtest/gtest.h>

namespace azimuth {
namespace {

/// Every trouble has words, in one line, and a key or column to look at where there is one.
TEST(Sentence, OfEveryTroubleIsOne) {
  for (int i = 1; i <= static_cast<int>(SampleTrouble::no_identities); ++i) {
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
  finding.sets = {stamp_from_us(1'000'000'000), stamp_from_us(36'000'000'000), 50};
  EXPECT_EQ(sentence(finding),
            "bearings are not of the odometry's time (odometry 0 to 36 s, bearings 1000 to 36000 s): are the stamps of "
            "two clocks, or in two units? t_s is in seconds, utime in microseconds");
}

}  // namespace
}  // namespace azimuth
