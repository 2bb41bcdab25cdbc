// How a session finds the robot: at any baud rate, over TCP, and after remains of an earlier session.

#include <gmock/gmock.h>

#include "drivers/pioneer/session.hpp"
#include "tests/drivers/pioneer/session_bench.hpp"

namespace azimuth::pioneer {
namespace {

using test::ByteVector;
using test::fixed;
using test::SessionBench;
using testing::ElementsAre;
using testing::HasSubstr;
using namespace std::chrono_literals;

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
  EXPECT_EQ(bench.count(encode_command(Command::host_baud, 4)), 0);
}

/// The last commands on a connection end any state that prevents synchronisation; the next connection starts with
/// SYNC0.
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
    closes.push_back(bench.count(close));
    opens.push_back(bench.count(open));
    EXPECT_EQ(bench.count(encode_command(kSync0)), 2);
    EXPECT_EQ(bench.controller.commands.front(), ByteVector{kSync0});
  }
  EXPECT_THAT(closes, ElementsAre(1, 1, 1, 1, 1));
  EXPECT_THAT(opens, ElementsAre(0, 0, 1, 0, 0)) << "a controller may hang half way through a synchronisation";
}

/// A radio link or a busy server: the answer to the first SYNC0 arrives after the second was sent.
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

TEST(PioneerSession, ClosesASessionFoundOpen) {
  SessionBench bench;
  bench.controller.open = true;
  bench.begin();
  bench.run(2s);
  EXPECT_EQ(bench.session.old_sessions(), 1U);
  EXPECT_EQ(bench.session.phase(), SessionPhase::running);
  EXPECT_EQ(bench.session.opened(), 1U);
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
  EXPECT_EQ(bench.count(encode_command(Command::host_baud, 4)), 0);
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

}  // namespace
}  // namespace azimuth::pioneer
