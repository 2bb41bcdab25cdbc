// The dialogue with the controller, in virtual time.

#include "drivers/pioneer/session.hpp"

#include <gmock/gmock.h>

#include "tests/drivers/pioneer/session_bench.hpp"

namespace azimuth::pioneer {
namespace {

using test::SessionBench;
using testing::Contains;
using testing::HasSubstr;
using namespace std::chrono_literals;

TEST(PioneerSession, OpensAndAsksForWhatOdometryNeeds) {
  SessionBench bench;
  bench.begin();
  bench.run(1s);
  EXPECT_EQ(bench.session.phase(), SessionPhase::running);
  EXPECT_EQ(bench.session.robot().name, "Tester");
  EXPECT_EQ(bench.session.robot().subclass, "p3dx-sh");
  EXPECT_EQ(bench.session.config()->ticks_per_mm, 128);
  EXPECT_FALSE(bench.session.config_unverified());
  EXPECT_EQ(bench.session.opened(), 1U);
  EXPECT_EQ(bench.session.baud(), 9600);
  EXPECT_EQ(bench.count(encode_command(Command::sonar, 0)), 1);
  EXPECT_TRUE(bench.controller.sends_encoder);
  EXPECT_FALSE(bench.controller.sends_gyro) << "it has none";
}

TEST(PioneerSession, KeepsTheWatchdogQuiet) {
  SessionBench bench;
  bench.begin();
  bench.run(1s);
  const auto before = bench.count(encode_command(Command::pulse));
  bench.run(60s);
  EXPECT_GE(bench.count(encode_command(Command::pulse)) - before, 100);
}

TEST(PioneerSession, RefusesAnUnknownRobotAndNamesTheKnown) {
  SessionBench bench;
  bench.controller.config.subclass = "hexapod";
  bench.begin();
  bench.run(1s);
  EXPECT_EQ(bench.gave_up, 1);
  EXPECT_THAT(bench.session.reason(), testing::AllOf(HasSubstr("hexapod"), HasSubstr("p3dx-sh")));
  EXPECT_EQ(bench.session.phase(), SessionPhase::idle);
  EXPECT_FALSE(bench.controller.open);
}

TEST(PioneerSession, AcceptsAnUnknownRobotThatIsConfigured) {
  PioneerSettings settings;
  settings.subclass = "p3at";
  SessionBench bench(settings);
  bench.controller.config.subclass = "hexapod";
  bench.begin();
  bench.run(1s);
  EXPECT_EQ(bench.session.phase(), SessionPhase::running);
  EXPECT_DOUBLE_EQ(bench.session.parameters().distance_m_per_unit, 0.465e-3);
}

TEST(PioneerSession, BelievesAConfigWithAWrongChecksum) {
  SessionBench bench;
  bench.controller.config_checksum_is_wrong = true;
  bench.begin();
  bench.run(1s);
  EXPECT_EQ(bench.session.phase(), SessionPhase::running);
  ASSERT_TRUE(bench.session.config());
  EXPECT_TRUE(bench.session.config_unverified());
  EXPECT_EQ(bench.session.config()->name, "Tester");
}

TEST(PioneerSession, RunsWithoutConfig) {
  SessionBench bench;
  bench.controller.answers_config = false;
  bench.begin();
  bench.run(2s);
  EXPECT_EQ(bench.session.phase(), SessionPhase::running);
  EXPECT_FALSE(bench.session.config());
  EXPECT_EQ(bench.count(encode_command(Command::config)), 2);
  EXPECT_FALSE(bench.controller.sends_encoder) << "ticks of unknown size";
}

TEST(PioneerSession, AsksForTheAnalogGyroOnly) {
  for (const int gyro : {0, 1, 2}) {
    SessionBench bench;
    bench.controller.config.gyro = static_cast<std::uint8_t>(gyro);
    bench.begin();
    bench.run(1s);
    EXPECT_EQ(bench.controller.sends_gyro, gyro == 1) << gyro;
    EXPECT_EQ(bench.session.uses_gyro(), gyro == 1) << "2: firmware corrects the heading already";
  }
}

TEST(PioneerSession, LeavesOutWhatIsSwitchedOff) {
  PioneerSettings settings;
  settings.encoder = settings.gyro = PioneerFeature::off;
  SessionBench bench(settings);
  bench.controller.config.gyro = 1;
  bench.begin();
  bench.run(3s);
  EXPECT_FALSE(bench.controller.sends_encoder || bench.controller.sends_gyro);
}

TEST(PioneerSession, RepeatsARequestThatWasLost) {
  SessionBench bench;
  bench.controller.config.gyro = 1;
  bench.begin();
  bench.run(300ms);
  bench.controller.sends_gyro = false;
  bench.controller.sip.sonar_count = 4;
  bench.controller.commands.clear();
  bench.run(1500ms);
  EXPECT_TRUE(bench.controller.sends_gyro);
  EXPECT_THAT(bench.controller.commands, Contains(test::data_of(encode_command(Command::sonar, 0))));
}

TEST(PioneerSession, IsDueWhenItSaysSo) {
  SessionBench bench;
  bench.begin();
  bench.run(1s);
  const auto due = bench.session.due_in(bench.now);
  EXPECT_GT(due, 0ms);
  EXPECT_LE(due, 500ms);
}

}  // namespace
}  // namespace azimuth::pioneer
