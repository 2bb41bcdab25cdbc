// A controller behind TCP that hangs for some seconds: the time until odometry returns, and the motion that it loses.

#include <algorithm>
#include <cstdio>
#include <gtest/gtest.h>
#include <ostream>
#include <string_view>

#include "tests/robot/tcp_bench.hpp"
#include "tests/robot/wheel_reference.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;

constexpr double kSpeed_m_per_s = 0.5;

/// The part that hangs, which determines what happens to the bytes.
enum class Hang {
  line,             ///< the line behind the bridge is dead; the bytes are lost
  bridge,           ///< the bridge accepts connections and forgets them, including the client's own
  controller,       ///< the bridge stores the bytes until the controller reads again
  server,           ///< the serving program is stopped; the bytes wait
  makers_simulator  ///< as `server`, and the program ends the session with the connection
};

std::string_view name(Hang hang) {
  switch (hang) {
    case Hang::line:
      return "line";
    case Hang::bridge:
      return "bridge";
    case Hang::controller:
      return "controller";
    case Hang::server:
      return "server";
    case Hang::makers_simulator:
      break;
  }
  return "makers simulator";
}
std::ostream& operator<<(std::ostream& out, Hang hang) { return out << name(hang); }

struct Comeback {
  double after_s = 0.0;  ///< from the end of the hang to the first reading
  std::uint64_t sessions = 0;
  double drift_m = 0.0;  ///< distance error since the start, if the origin is the same
  bool same_origin = false;
};

Comeback comeback_after(Hang hang, Duration duration) {
  EvenChassis chassis{{kSpeed_m_per_s, 0.0}};
  TcpBench bench(chassis);
  bench.ends_session_with_client = hang == Hang::makers_simulator;
  bench.run(3s);
  if (bench.readings.empty()) return {.after_s = 1e9};
  const OdometryReading first = bench.readings.front();
  bench.stopped = hang == Hang::server || hang == Hang::makers_simulator;
  bench.lets_die = hang == Hang::bridge;
  bench.holds_back = hang == Hang::controller;
  if (hang == Hang::line) bench.pioneer().silence(duration);
  bench.run(duration);
  bench.stopped = bench.lets_die = bench.holds_back = false;
  Comeback comeback;
  comeback.after_s = to_seconds(bench.run_to_reading(20s));
  bench.run(2s);
  const OdometryReading last = bench.readings.back();
  comeback.sessions = bench.state().sessions;
  comeback.same_origin = last.origin == first.origin;
  const double driven_m = kSpeed_m_per_s * to_seconds(last.stamp - first.stamp);
  comeback.drift_m = last.T_odom_body.x_m - first.T_odom_body.x_m - driven_m;
  return comeback;
}

class HangTest : public testing::TestWithParam<Hang> {};

TEST_P(HangTest, OdometryIsBackWithinASecond) {
  std::vector<double> after_s;
  for (Duration duration = 4s; duration <= 7s; duration += 50ms) {
    const Comeback comeback = comeback_after(GetParam(), duration);
    after_s.push_back(comeback.after_s);
    if (GetParam() == Hang::makers_simulator) continue;
    EXPECT_TRUE(comeback.same_origin) << to_seconds(duration) << " s";
    EXPECT_EQ(comeback.sessions, 1U) << "the controller counted on";
    EXPECT_NEAR(comeback.drift_m, 0.0, 0.005);
  }
  std::ranges::sort(after_s);
  RecordProperty("median_s", std::to_string(after_s[after_s.size() / 2]));
  RecordProperty("worst_s", std::to_string(after_s.back()));
  std::printf("back after %.2f s (median), %.2f s (worst) of %zu hangs\n", after_s[after_s.size() / 2], after_s.back(),
              after_s.size());
  EXPECT_LT(after_s.back(), 1.0);
}

/// A robot that changes its port when its client hangs up, and a client that knows only the first port.
class MovingRobot : public testing::Test {
 protected:
  MovingRobot() { bench_.ends_session_with_client = bench_.moves_when_hung_up_on = true; }

  /// The server hangs repeatedly, each time for a different time from 4 to 7 s.
  void expect_to_have_it_back_after_each_hang() {
    bench_.run(3s);
    ASSERT_FALSE(bench_.readings.empty());
    const OdometryReading first = bench_.readings.front();
    std::vector<double> after_s;
    for (int hang = 0; hang < kHangs; ++hang) {
      bench_.stopped = true;
      bench_.run(4s + hang * 3000ms / (kHangs - 1));
      bench_.stopped = false;
      after_s.push_back(to_seconds(bench_.run_to_reading(20s)));
      EXPECT_LT(after_s.back(), 0.5) << "hang " << hang;
      bench_.run(2s);
    }
    EXPECT_EQ(bench_.moves(), 0U) << "it was never hung up on";
    EXPECT_EQ(bench_.state().sessions, 1U);
    EXPECT_EQ(bench_.state().connection, Connection::running);
    const OdometryReading last = bench_.readings.back();
    EXPECT_EQ(last.origin, first.origin);
    EXPECT_NEAR(last.T_odom_body.x_m - first.T_odom_body.x_m, kSpeed_m_per_s * to_seconds(last.stamp - first.stamp),
                0.01);
    std::printf("back after %.2f s at worst of %zu hangs\n", std::ranges::max(after_s), after_s.size());
  }

  static constexpr int kHangs = 20;
  EvenChassis chassis_{{kSpeed_m_per_s, 0.0}};
  TcpBench bench_{chassis_};
};

TEST_F(MovingRobot, ThatRefusesOthersIsBackWithinHalfASecond) {
  bench_.refuses_others = true;
  expect_to_have_it_back_after_each_hang();
}

TEST_F(MovingRobot, ThatLetsOthersWaitIsBackWithinHalfASecond) { expect_to_have_it_back_after_each_hang(); }

TEST_F(MovingRobot, ThatIsSilentForLongerThanItsCountersCanTellIsNotHungUpOnEither) {
  bench_.run(3s);
  bench_.stopped = true;
  bench_.run(20s);  // at most 44 m; the counters wrap after 33 m
  bench_.stopped = false;
  EXPECT_LT(bench_.run_to_reading(20s), 1s);
  EXPECT_EQ(bench_.moves(), 0U);
  EXPECT_EQ(bench_.state().sessions, 2U) << "another origin";
}

TEST_F(MovingRobot, WhoseControllerRestartsMeanwhileIsFoundOnTheConnectionThatStands) {
  bench_.run(3s);
  bench_.stopped = true;
  bench_.run(5s);
  bench_.pioneer().reboot(0xFF);
  bench_.stopped = false;
  EXPECT_LT(bench_.run_to_reading(20s), 3s);
  EXPECT_EQ(bench_.moves(), 0U);
}

TEST(BridgeInTelnetMode, IsNamedAndMadeUpFor) {
  // GIVEN a robot that drives backwards in a curve, so that its speeds contain many bytes 0xFF
  EvenChassis chassis{{-0.2, -0.3}};
  TcpBench bench(chassis);
  bench.speaks_telnet = true;
  bench.run(60s);
  EXPECT_EQ(bench.state().bad_checksums, 0U);
  EXPECT_EQ(bench.state().stale, 0U);
  EXPECT_EQ(bench.state().sessions, 1U);
  EXPECT_GT(bench.readings.size(), 550U);
  EXPECT_EQ(std::ranges::count_if(bench.events,
                                  [](const std::string& event) {
                                    return event.find("is in telnet mode") != std::string::npos &&
                                           event.find("raw TCP mode") != std::string::npos;
                                  }),
            1);
}

TEST(BridgeForOneClient, ThatForgotItsClientIsHungUpOnAtLast) {
  // GIVEN a server that keeps a dead connection and therefore rejects others
  EvenChassis chassis{{kSpeed_m_per_s, 0.0}};
  TcpBench bench(chassis);
  bench.run(3s);
  bench.client_is_dead = true;
  bench.run(40s);
  EXPECT_EQ(bench.state().connection, Connection::running);
}

INSTANTIATE_TEST_SUITE_P(Of, HangTest,
                         testing::Values(Hang::line, Hang::bridge, Hang::controller, Hang::server,
                                         Hang::makers_simulator),
                         PrintedName());

}  // namespace
}  // namespace azimuth::test
