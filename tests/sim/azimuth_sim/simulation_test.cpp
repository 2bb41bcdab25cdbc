// World, robot and line in virtual time, with a client on the line.

#include "sim/azimuth_sim/simulation.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "drivers/pioneer/protocol.hpp"

namespace azimuth::sim {
namespace {

using namespace std::chrono_literals;
using pioneer::Command;
using pioneer::encode_command;

/// A simulation with a client that opens a session at once and keeps it alive.
class Session {
 public:
  explicit Session(const SimulationSettings& settings) : simulation(settings) {
    for (const std::uint8_t sync : {pioneer::kSync0, pioneer::kSync1, pioneer::kSync2, pioneer::kSync1}) {
      send(encode_command(sync));
      run(50ms);
    }
    send(encode_command(Command::sonar, 0));
  }

  void send(const pioneer::Frame& frame) { simulation.pioneer().client_sends(frame.view(), now); }
  /// Advances in steps of `step` and sends PULSE from time to time.
  void run(Duration duration, Duration step = 10ms) {
    for (const Stamp end = now + duration; now < end;) {
      now = std::min(end, now + step);
      simulation.advance(now, output);
      if (to_us(now) % 500'000 == 0) send(encode_command(Command::pulse));
    }
    simulation.pioneer().take_bytes(bytes);
  }

  Simulation simulation;
  SimulationOutput output;
  Bytes bytes;
  Stamp now{};
};

SimulationSettings settings_of(const Scenario& scenario, FaultSchedule faults = {}) {
  return {scenario, PioneerModel{}, std::move(faults), std::nullopt};
}

Fault fault_of(std::string_view text) { return parse_fault(text).value(); }

TEST(Simulation, ShowsWhatARecordedRunShows) {
  const Scenario scenario = lab(5, 1);
  const World world = simulate(scenario);
  Session session(settings_of(scenario));
  session.run(40s);
  ASSERT_GE(session.output.bearings.size(), 199U);
  for (std::size_t i = 0; i < session.output.bearings.size(); ++i) {
    const BearingSet &seen = session.output.bearings[i], &recorded = world.bearings[i];
    ASSERT_EQ(seen.stamp, recorded.stamp);
    ASSERT_EQ(seen.sequence, recorded.sequence);
    ASSERT_EQ(seen.bearings.size(), recorded.bearings.size());
    for (std::size_t j = 0; j < seen.bearings.size(); ++j) {
      EXPECT_NEAR(seen.bearings[j].azimuth_rad, recorded.bearings[j].azimuth_rad, 2e-6);
      EXPECT_EQ(seen.bearings[j].identity, recorded.bearings[j].identity);
    }
  }
}

// The odometry on the line equals that of the scenario, including drift, up to the resolution of 1 mm and of counts.
TEST(Simulation, SipsDriftAsTheScenariosOdometerDoes) {
  const Scenario scenario = lab(6, 1);
  Session session(settings_of(scenario));
  session.run(70s);
  ASSERT_GE(session.output.latches.size(), 690U);
  Rover rover(scenario, PioneerModel{}.track_mm / 1000.0);
  const Pose2 T_odom_open = rover.pose_in_odom(session.output.latches.front().stamp - 100ms);
  for (const SipLatch& latch : session.output.latches) {
    const Pose2 T_open_body = inverse(T_odom_open) * rover.pose_in_odom(latch.stamp);
    EXPECT_NEAR(static_cast<std::int16_t>(latch.pose.x), 1e3 * T_open_body.x_m, 4.0);
    EXPECT_NEAR(static_cast<std::int16_t>(latch.pose.y), 1e3 * T_open_body.y_m, 4.0);
    EXPECT_NEAR(wrap(latch.pose.heading * 2 * kPi / kHeadingCounts - T_open_body.heading_rad), 0.0, 0.003);
  }
}

TEST(Simulation, FaultsComeWhenTheyAreDue) {
  Session session(settings_of(lab(1), FaultSchedule({{Stamp(3s), fault_of("lose_sips=1")}},
                                                    {fault_of("lose_sips=0"), fault_of("noise=0")}, 5s)));
  session.run(5800ms);  // to t = 6 s
  ASSERT_EQ(session.output.faults.size(), 2U);
  EXPECT_EQ(session.output.faults[0].text(), "lose_sips=1");
  EXPECT_EQ(session.output.faults[1].text(), "lose_sips=0");
  EXPECT_NEAR(static_cast<double>(session.simulation.pioneer().counts().lost_sips), 20.0, 1.0);
}

TEST(Simulation, AClientDrivesAndLetsGo) {
  Session session(settings_of(lab(2, 1)));
  session.run(3s);
  session.send(encode_command(Command::enable, 1));
  session.send(encode_command(Command::velocity, 0));
  session.run(1s);
  const Pose2 held = session.simulation.pose_in_world(session.now);
  session.run(5s);
  EXPECT_EQ(session.simulation.pose_in_world(session.now), held);
  session.send(encode_command(Command::close));
  session.run(5s);
  EXPECT_GT((session.simulation.pose_in_world(session.now).position() - held.position()).norm(), 1.0);
}

TEST(Simulation, LeftAloneItStandsIfItIsToAndAClientMayDriveIt) {
  SimulationSettings settings = settings_of(lab(2, 1));
  settings.left_alone = LeftAlone::stands;
  Session session(settings);
  const Pose2 start = session.simulation.pose_in_world(session.now);
  session.run(20s);
  EXPECT_EQ(session.simulation.pose_in_world(session.now), start);
  EXPECT_FALSE(session.simulation.rover().arrived());
  session.send(encode_command(Command::enable, 1));
  session.send(encode_command(Command::move, 1000));
  session.run(8s);
  const Pose2 there = session.simulation.pose_in_world(session.now);
  EXPECT_NEAR((there.position() - start.position()).norm(), 1.0, 0.1) << "as far as wheels and floor agree";
  session.send(encode_command(Command::close));
  session.run(5s);
  EXPECT_EQ(session.simulation.pose_in_world(session.now), there);
}

/// Evaluations interpolate the truth linearly between its samples.
TEST(Simulation, TheTruthIsTakenOftenEnoughToInterpolate) {
  for (const Scenario& scenario : {coloured_lab(2), lab(2, 1)}) {
    Session session(settings_of(scenario));
    session.run(20s);
    const std::vector<TruePose>& truth = session.output.truth;
    Rover rover(scenario, PioneerModel{}.track_mm / 1000.0);
    double worst_m = 0.0, worst_rad = 0.0;
    for (std::size_t i = 1; i < truth.size(); ++i) {
      const Stamp middle = truth[i - 1].stamp + (truth[i].stamp - truth[i - 1].stamp) / 2;
      const Pose2 line = interpolate(truth[i - 1].T_world_body, truth[i].T_world_body, 0.5);
      const Pose2 exact = rover.pose_in_world(middle);
      worst_m = std::max(worst_m, (line.position() - exact.position()).norm());
      worst_rad = std::max(worst_rad, std::abs(wrap(line.heading_rad - exact.heading_rad)));
    }
    EXPECT_LT(worst_m, 1e-9) << scenario.name;
    EXPECT_LT(worst_rad, 1e-9) << scenario.name;
  }
}

TEST(Simulation, FramesAreAskedForAtTheirRate) {
  SimulationSettings settings = settings_of(lab(1));
  settings.frame_period = 66667us;
  Session session(settings);
  session.run(10s);
  EXPECT_NEAR(static_cast<double>(session.output.frames.size()), 153.0, 1.0);
}

Session eventful_half_minute(std::uint64_t seed, Duration step) {
  Session session(settings_of(
      lab(seed), FaultSchedule({{Stamp(2s), fault_of("noise=0.001")}, {Stamp(5s), fault_of("lose_bytes=0.001")}},
                               {fault_of("lose_sips=0.2"), fault_of("silence=0.3"), fault_of("reboot")}, 7s)));
  session.run(30s, step);
  return session;
}

TEST(Simulation, TheSameSeedGivesTheSameLineHoweverTimePasses) {
  const Session fine = eventful_half_minute(1, 1ms), coarse = eventful_half_minute(1, 100ms);
  EXPECT_EQ(fine.bytes, coarse.bytes);
  EXPECT_EQ(fine.output.truth, coarse.output.truth);
  EXPECT_NE(fine.bytes, eventful_half_minute(2, 1ms).bytes);
}

// Soak tests of drivers need half an hour of simulated time within seconds.
TEST(Simulation, HalfAnHourPassesInSeconds) {
  Session session(settings_of(lab(1, 30)));
  session.send(encode_command(Command::encoder, 2));
  session.run(30min, 100ms);
  EXPECT_GT(session.simulation.pioneer().counts().sips, 17'900U);
  EXPECT_GT(session.bytes.size(), 17'900U * (41 + 14));
}

}  // namespace
}  // namespace azimuth::sim
