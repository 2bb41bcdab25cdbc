// The conversation with the controller, in virtual time.

#include "drivers/pioneer/session.hpp"

#include <gmock/gmock.h>
#include <memory>

#include "tests/drivers/pioneer/session_bench.hpp"

namespace azimuth::pioneer {
namespace {

using test::ByteVector;
using test::SessionBench;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using namespace std::chrono_literals;

/// How often the robot got a command.
std::int64_t count(const SessionBench& bench, const Frame& frame) {
  return std::ranges::count(bench.controller.commands, test::data_of(frame));
}

PioneerSettings fixed(int baud) {
  PioneerSettings settings;
  settings.baud = baud;
  return settings;
}

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
  EXPECT_EQ(count(bench, encode_command(Command::sonar, 0)), 1);
  EXPECT_TRUE(bench.controller.sends_encoder);
  EXPECT_FALSE(bench.controller.sends_gyro) << "it has none";
}

TEST(PioneerSession, KeepsTheWatchdogQuiet) {
  SessionBench bench;
  bench.begin();
  bench.run(1s);
  const auto before = count(bench, encode_command(Command::pulse));
  bench.run(60s);
  EXPECT_GE(count(bench, encode_command(Command::pulse)) - before, 100);
}

TEST(PioneerSession, FindsEveryBaudRate) {
  for (const int baud : kControllerBauds) {
    SessionBench bench;
    bench.controller.start_baud = bench.controller.baud = baud;
    bench.begin();
    bench.run(2500ms);
    EXPECT_EQ(bench.session.phase(), SessionPhase::running) << baud;
    EXPECT_EQ(bench.session.baud(), baud);
  }
}

TEST(PioneerSession, HasNoBaudRateOverTcp) {
  SessionBench bench({}, false);
  bench.controller.config.auto_baud = ConfigPacket::kAutoBaudResets;
  bench.begin();
  bench.run(1s);
  EXPECT_EQ(bench.session.phase(), SessionPhase::running);
  EXPECT_EQ(bench.session.baud(), 0);
  EXPECT_EQ(bench.line_baud, 0);
  EXPECT_EQ(count(bench, encode_command(Command::host_baud, 4)), 0);
}

/// What hinders a synchronisation is ended by the last words on a connection, and the next one begins with SYNC0.
TEST(PioneerSession, OverTcpGivesUpAfterOneRound) {
  SessionBench bench({}, false);
  std::vector<std::int64_t> closes, opens;
  const Frame close = encode_command(Command::close), open = encode_command(Command::open);
  bench.controller.answers_nothing = true;
  for (int link = 1; link <= 5; ++link) {
    bench.controller.commands.clear();
    bench.begin();
    bench.run(1200ms);
    EXPECT_EQ(bench.gave_up, link);
    closes.push_back(count(bench, close));
    opens.push_back(count(bench, open));
    EXPECT_EQ(count(bench, encode_command(kSync0)), 2);
    EXPECT_EQ(bench.controller.commands.front(), ByteVector{kSync0});
  }
  EXPECT_THAT(closes, ElementsAre(1, 1, 1, 1, 1));
  EXPECT_THAT(opens, ElementsAre(0, 0, 1, 0, 0)) << "a controller may hang half way through a synchronisation";
}

/// A radio link, or a server that is busy. The answer to the first SYNC0 comes after the second was sent.
TEST(PioneerSession, OverTcpAnswersMayTakeLong) {
  SessionBench bench({}, false);
  bench.controller.answers_nothing = true;
  bench.begin();
  for (const std::uint8_t sync : {kSync0, kSync0, kSync1}) {
    bench.run(450ms);
    bench.hear(encode_frame(ByteVector{sync}).view(), 0);
  }
  bench.run(450ms);
  bench.hear(encode_frame(ByteVector{kSync2, 'A', 0, 'B', 0, 'p', '3', 'd', 'x', 0}).view(), 0);
  EXPECT_EQ(bench.gave_up, 0);
  EXPECT_EQ(bench.session.phase(), SessionPhase::opening);
}

/// It may have counted on and only be silent; after so long that its position may have wrapped, it may as well end.
TEST(PioneerSession, SaysNothingThatEndsItsOwnSessionWhileThatMayGoOn) {
  for (const bool has_baud : {false, true}) {
    SessionBench bench({}, has_baud);
    bench.begin();
    bench.run(2s);
    ASSERT_EQ(bench.session.phase(), SessionPhase::running);
    bench.controller.commands.clear();
    bench.controller.answers_nothing = true;
    for (const auto end = bench.now + 7s; bench.now < end; bench.run(50ms))
      if (bench.session.phase() == SessionPhase::idle) bench.begin();
    EXPECT_EQ(count(bench, encode_command(Command::close)), 0);
    EXPECT_EQ(count(bench, encode_command(Command::open)), 0);
    for (const auto end = bench.now + 8s; bench.now < end; bench.run(50ms))
      if (bench.session.phase() == SessionPhase::idle) bench.begin();
    EXPECT_GE(count(bench, encode_command(Command::close)), 1);
  }
}

TEST(PioneerSession, ClosesASessionFoundOpen) {
  SessionBench bench;
  bench.controller.open = true;
  bench.begin();
  bench.run(2s);
  EXPECT_EQ(bench.session.old_sessions(), 1U);
  EXPECT_EQ(bench.session.phase(), SessionPhase::running);
  EXPECT_EQ(bench.session.opened(), 1U);
}

/// A session that runs, whose line is then cut for `outage`.
void cut_line(SessionBench& bench, Clock::duration outage) {
  bench.begin();
  bench.run(3s);
  ASSERT_EQ(bench.session.phase(), SessionPhase::running);
  bench.connected = false;
  bench.session.drop();
  bench.run(outage);
  bench.connected = true;
}

TEST(PioneerSession, GoesOnWithItsOwnAfterABreakOfTheLine) {
  SessionBench bench;
  bench.controller.config.auto_baud = ConfigPacket::kAutoBaudResets;
  cut_line(bench, 1500ms);
  bench.begin();
  bench.run(200ms);
  EXPECT_EQ(bench.session.phase(), SessionPhase::running);
  EXPECT_EQ(bench.session.opened(), 1U);
  EXPECT_EQ(bench.session.resumed(), 1U);
  EXPECT_EQ(bench.session.old_sessions(), 0U);
  EXPECT_EQ(bench.session.baud(), 115200);
}

TEST(PioneerSession, OpensAnewWhenThePositionMayHaveWrapped) {
  SessionBench bench;
  cut_line(bench, 8s);  // 17.6 m at most, of 16.4 m that can be told apart
  bench.begin();
  bench.run(2s);
  EXPECT_EQ(bench.session.phase(), SessionPhase::running);
  EXPECT_EQ(bench.session.opened(), 2U);
  EXPECT_EQ(bench.session.resumed(), 0U);
}

TEST(PioneerSession, OpensAnewWhenTheControllerHasForgottenTheSession) {
  SessionBench bench;
  cut_line(bench, 1s);
  bench.controller.open = false;
  bench.begin();
  bench.run(2s);
  EXPECT_EQ(bench.session.opened(), 2U);
  EXPECT_EQ(bench.session.resumed(), 0U);
}

TEST(PioneerSession, ClosesASessionLeftOpenAtAnotherRate) {
  SessionBench bench(fixed(9600));
  bench.controller.config.auto_baud = ConfigPacket::kAutoBaudResets;
  bench.controller.open = true;
  bench.controller.baud = 115200;
  bench.begin();
  bench.run(2s);
  EXPECT_EQ(bench.session.phase(), SessionPhase::running);
}

TEST(PioneerSession, RestartsAfterAWrongSyncCount) {
  SessionBench bench;
  bench.controller.receive(encode_command(kSync0).view(), 9600);
  bench.begin();
  bench.run(1s);
  EXPECT_EQ(bench.session.phase(), SessionPhase::running);
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
  EXPECT_EQ(count(bench, encode_command(Command::config)), 2);
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

TEST(PioneerSession, RaisesTheBaudRateWhereTheRobotFallsBack) {
  SessionBench bench;
  bench.controller.config.auto_baud = ConfigPacket::kAutoBaudResets;
  bench.begin();
  bench.run(1s);
  EXPECT_EQ(bench.session.phase(), SessionPhase::running);
  EXPECT_EQ(bench.session.baud(), 115200);
  EXPECT_EQ(bench.controller.baud, 115200);
  bench.close();
  EXPECT_EQ(bench.controller.baud, 9600);
}

TEST(PioneerSession, LeavesTheBaudRateOtherwise) {
  SessionBench bench;
  bench.controller.config.auto_baud = 1;
  bench.begin();
  bench.run(2s);
  EXPECT_EQ(bench.session.phase(), SessionPhase::running);
  EXPECT_EQ(count(bench, encode_command(Command::host_baud, 4)), 0);
}

TEST(PioneerSession, GoesOnWhereTheRobotDoesNotFollowToAHigherRate) {
  SessionBench bench;
  bench.controller.config.auto_baud = ConfigPacket::kAutoBaudResets;
  bench.controller.follows_host_baud = false;
  bench.begin();
  bench.run(3s);
  EXPECT_EQ(bench.session.phase(), SessionPhase::running);
  EXPECT_EQ(bench.session.baud(), 9600);
  EXPECT_TRUE(bench.session.baud_refused());
  EXPECT_EQ(bench.gave_up, 0);
}

TEST(PioneerSession, FindsARaisedSessionAgainAfterTheLinkBroke) {
  SessionBench bench;
  bench.controller.config.auto_baud = ConfigPacket::kAutoBaudResets;
  bench.begin();
  bench.run(1s);
  ASSERT_EQ(bench.controller.baud, 115200);
  bench.session.drop();
  bench.begin();
  bench.run(300ms);
  EXPECT_EQ(bench.session.phase(), SessionPhase::running);
  EXPECT_EQ(bench.session.opened(), 1U);
  EXPECT_EQ(bench.session.resumed(), 1U);
  EXPECT_EQ(bench.session.baud(), 115200);
}

TEST(PioneerSession, IsBackWithinTwoSecondsOfAPowerCycle) {
  SessionBench bench;
  bench.controller.config.auto_baud = ConfigPacket::kAutoBaudResets;
  bench.begin();
  bench.run(1s);
  bench.session.drop();
  bench.controller.restart();
  bench.begin();
  bench.run(2s);
  EXPECT_EQ(bench.session.phase(), SessionPhase::running);
}

TEST(PioneerSession, GivesUpAnOpenLinkWithoutOdometry) {
  SessionBench bench;
  bench.begin();
  bench.run(1s);
  bench.connected = false;
  bench.run(1900ms);
  EXPECT_EQ(bench.gave_up, 0);
  bench.run(300ms);
  EXPECT_EQ(bench.gave_up, 1);
  EXPECT_THAT(bench.session.reason(), HasSubstr("no odometry"));
}

TEST(PioneerSession, GivesUpALinkWithoutARobot) {
  SessionBench bench(fixed(9600));
  bench.connected = false;
  bench.begin();
  bench.run(5s);
  EXPECT_EQ(bench.gave_up, 1);
  EXPECT_THAT(bench.session.reason(), HasSubstr("no answer"));
  EXPECT_EQ(bench.session.due_in(bench.now), Clock::duration::max());
}

TEST(PioneerSession, GivesUpALineThatOnlyEchoes) {
  SessionBench bench;
  bench.connected = false;
  bench.begin();
  for (int i = 0; i < 200 && bench.gave_up == 0; ++i) {
    bench.connected = true;
    bench.controller.commands.clear();
    for (const std::uint8_t number : {kSync0, kSync1, kSync2})
      bench.hear(encode_command(number).view(), bench.line_baud);
    bench.connected = false;
    bench.run(100ms);
  }
  EXPECT_EQ(bench.gave_up, 1);
  EXPECT_EQ(bench.session.opened(), 0U);
}

TEST(PioneerSession, OpensAnewAfterTheControllerRestarted) {
  for (const std::uint8_t id : {packet_id::reboot, packet_id::reboot_with_data}) {
    SessionBench bench;
    bench.controller.config.auto_baud = ConfigPacket::kAutoBaudResets;
    bench.begin();
    bench.run(1s);
    bench.hear(encode_frame(ByteVector{id}).view(), 115200);
    bench.controller.restart();
    bench.run(1500ms);
    EXPECT_EQ(bench.session.phase(), SessionPhase::running);
    EXPECT_EQ(bench.session.reboots(), 1U);
    EXPECT_EQ(bench.session.opened(), 2U);
    EXPECT_EQ(bench.gave_up, 0);
  }
}

TEST(PioneerSession, EndsCleanly) {
  SessionBench bench;
  bench.controller.config.gyro = 1;
  bench.begin();
  bench.run(1s);
  bench.controller.commands.clear();
  bench.close();
  EXPECT_THAT(bench.controller.commands, ElementsAre(test::data_of(encode_command(Command::encoder, 0)),
                                                     test::data_of(encode_command(Command::gyro, 0)),
                                                     test::data_of(encode_command(Command::sonar, 0)), ByteVector{2}));
  EXPECT_EQ(bench.ended, 1);
  EXPECT_FALSE(bench.controller.open);
  EXPECT_EQ(bench.session.phase(), SessionPhase::ended);
}

/// Another process's session at the same controller, which goes on with `bench`'s after `away`.
std::unique_ptr<SessionBench> next_process(const SessionBench& bench, Clock::duration away,
                                           const PioneerSettings& settings = {}) {
  auto next = std::make_unique<SessionBench>(settings);
  next->controller = bench.controller;
  next->now = bench.now + away;
  const auto memory = bench.session.memory();
  EXPECT_TRUE(memory && next->session.restore(*memory));
  return next;
}

TEST(PioneerSession, LeavesTheControllerCountingForTheNextProcess) {
  SessionBench bench;
  bench.controller.config.auto_baud = ConfigPacket::kAutoBaudResets;
  EXPECT_FALSE(bench.session.memory());
  bench.begin();
  bench.run(1s);
  ASSERT_EQ(bench.controller.baud, 115200);
  bench.controller.commands.clear();
  bench.session.leave(bench.now);
  EXPECT_THAT(bench.controller.commands, testing::IsEmpty());
  EXPECT_TRUE(bench.controller.open);
  EXPECT_EQ(bench.session.phase(), SessionPhase::ended);

  const auto next = next_process(bench, 3s);
  next->begin();
  next->run(300ms);
  EXPECT_EQ(next->session.phase(), SessionPhase::running);
  EXPECT_EQ(next->session.opened(), 0U);
  EXPECT_EQ(next->session.resumed(), 1U);
  EXPECT_EQ(next->session.baud(), 115200);
  EXPECT_EQ(next->session.robot().name, "Tester");
  ASSERT_TRUE(next->session.config()) << "asked for again";
  EXPECT_EQ(next->session.config()->ticks_per_mm, 128);
}

TEST(PioneerSession, DoesNotGoOnWhenThePositionMayHaveWrappedMeanwhile) {
  SessionBench bench;
  bench.begin();
  bench.run(1s);
  const auto next = next_process(bench, 8s);  // 17.6 m, and the counter shows 16.4 to either side
  next->begin();
  next->run(2s);
  EXPECT_EQ(next->session.phase(), SessionPhase::running);
  EXPECT_EQ(next->session.resumed(), 0U);
  EXPECT_EQ(next->session.opened(), 1U);
}

TEST(PioneerSession, LeavesTheRateOfAnotherProcessAsItIs) {
  SessionBench bench;
  bench.controller.config.auto_baud = ConfigPacket::kAutoBaudResets;
  bench.controller.follows_host_baud = false;
  bench.begin();
  bench.run(3s);
  const auto next = next_process(bench, 1s);
  next->begin();
  next->controller.commands.clear();
  next->run(2s);
  EXPECT_EQ(next->session.phase(), SessionPhase::running);
  EXPECT_EQ(count(*next, encode_command(Command::host_baud, 4)), 0) << "it has tried";
}

TEST(PioneerSession, RestoresNothingOfARobotOrALineThatCannotBe) {
  Session session({}, true);
  const SessionMemory good{.robot = {"Tester", "Pioneer", "p3dx-sh"}, .start_baud = 9600, .baud = 115200, .heard = {}};
  SessionMemory bad = good;
  bad.robot.subclass = "hexapod";
  EXPECT_FALSE(session.restore(bad));
  bad = good;
  bad.baud = 12345;
  EXPECT_FALSE(session.restore(bad));
  EXPECT_FALSE(session.memory());
  EXPECT_TRUE(session.restore(good));
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
