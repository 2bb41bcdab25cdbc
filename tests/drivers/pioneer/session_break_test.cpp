// Behaviour of a session when its line breaks, its robot restarts or its process ends.

#include <gmock/gmock.h>
#include <memory>

#include "drivers/pioneer/session.hpp"
#include "tests/drivers/pioneer/session_bench.hpp"

namespace azimuth::pioneer {
namespace {

using test::ByteVector;
using test::SessionBench;
using testing::ElementsAre;
using testing::HasSubstr;
using namespace std::chrono_literals;

/// A silent controller may still count, so its session must not be closed. After so long that its position may have
/// wrapped, it may be closed.
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
    EXPECT_EQ(bench.count(encode_command(Command::close)), 0);
    EXPECT_EQ(bench.count(encode_command(Command::open)), 0);
    for (const auto end = bench.now + 8s; bench.now < end; bench.run(50ms))
      if (bench.session.phase() == SessionPhase::idle) bench.begin();
    EXPECT_GE(bench.count(encode_command(Command::close)), 1);
  }
}

/// A running session whose line is then cut for `outage`.
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
  cut_line(bench, 8s);  // up to 17.6 m, but only 16.4 m are unambiguous
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

/// The session of the next process at the same controller, which resumes the session of `bench` after `away`.
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
  // Up to 17.6 m, but the counter is unambiguous up to 16.4 m in either direction.
  const auto next = next_process(bench, 8s);
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
  EXPECT_EQ(next->count(encode_command(Command::host_baud, 4)), 0) << "it has tried";
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

}  // namespace
}  // namespace azimuth::pioneer
