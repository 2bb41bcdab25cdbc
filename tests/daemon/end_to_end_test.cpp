// azimuthd and the real lcm-logger in a network namespace of their own (in_namespace.sh). Every message is decoded and
// compared with a replay inside this process.

#include <bit>
#include <cstring>
#include <gmock/gmock.h>
#include <map>
#include <sstream>

#include "settings/configured_estimator.hpp"
#include "settings/rig.hpp"
#include "tests/daemon/child_process.hpp"
#include "tests/daemon/lcm_logger.hpp"
#include "tests/daemon/recorded_messages.hpp"
#include "tests/daemon/run_files.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr auto kPatience = 60s;
constexpr double kRun_s = 15.0;

/// Number of UDP datagrams sent in this network namespace so far.
std::uint64_t datagrams_sent() {
  std::ifstream counters("/proc/self/net/snmp");
  for (std::string line; std::getline(counters, line);) {
    std::istringstream fields(line);
    std::string protocol;
    std::uint64_t received = 0, without_port = 0, errors = 0, sent = 0;
    if (fields >> protocol >> received >> without_port >> errors >> sent && protocol == "Udp:") return sent;
  }
  return 0;
}

/// The number N of "N what" in the daemon's log; -1 if there is none.
std::int64_t logged_number(const std::string& log, const std::string& what) {
  const std::size_t end = log.find(" " + what);
  if (end == std::string::npos) return -1;
  return std::stoll(log.substr(log.find_last_of(' ', end - 1) + 1));
}

class EndToEnd : public ::testing::Test {
 protected:
  void SetUp() override {
    recording_ = test::small_recording(kRun_s);
    run_ = test::write_run(recording_, folder_.path() / "run");
    const FileResult<Rig> rig = read_rig_file(run_ / "rig.toml");
    ASSERT_TRUE(rig);
    expected_ = test::replay(recording_, configured_estimator(*rig, Configuration{}), *rig);
    ASSERT_GT(expected_.estimates.back().landmarks.size(), 0U) << "a map worth comparing";
  }

  /// Records one run of azimuthd with lcm-logger. On a busy machine the logger loses messages silently; the run is then
  /// recorded anew, up to six times.
  test::RecordedMessages record(const std::vector<std::string>& options, const std::string& prefix = "") {
    for (int attempt = 1;; ++attempt) {
      test::RecordedMessages heard = record_once(options, prefix);
      if (heard.count() == sent_) return heard;
      if (attempt == 6) {
        ADD_FAILURE() << "lcm-logger heard " << heard.count() << " of " << sent_ << " messages, the last of 6 attempts";
        return heard;
      }
    }
  }

  test::RecordedMessages record_once(const std::vector<std::string>& options, const std::string& prefix) {
    const std::filesystem::path log = folder_.path() / "heard.lcm";
    test::LcmLogger logger(log, folder_.path());
    if (!logger.hears()) return {};
    std::vector<std::string> command{AZIMUTHD, "--play", run_};
    command.insert(command.end(), options.begin(), options.end());
    const std::uint64_t sent_before = datagrams_sent();
    test::ChildProcess daemon(command, folder_.path());
    EXPECT_EQ(daemon.wait(kPatience), 0) << daemon.standard_error();
    sent_ = datagrams_sent() - sent_before;  // one datagram per message
    daemon_output_ = daemon.standard_output();
    daemon_log_ = daemon.standard_error();
    logger.finish();
    test::RecordedMessages heard = test::read_messages(log, prefix);
    std::erase(heard.foreign_channels, test::LcmLogger::kProbe);
    return heard;
  }

  test::TemporaryFolder folder_;
  Recording recording_;
  std::filesystem::path run_;
  test::Replayed expected_;
  std::string daemon_output_, daemon_log_;
  std::uint64_t sent_ = 0;
};

/// Expects every number of the pose message to equal the estimate to the last bit.
void expect_same_bits(const pose_cov_t& message, const Estimate& estimate) {
  const Eigen::Vector3d pose(message.x_m, message.y_m, message.heading_rad);
  EXPECT_EQ(pose, estimate.T_map_body.vector());
  EXPECT_EQ(message.odom_x_m, estimate.T_odom_body.x_m);
  EXPECT_EQ(message.odom_heading_rad, estimate.T_odom_body.heading_rad);
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> covariance(message.covariance);
  EXPECT_EQ(covariance, estimate.pose_covariance);
  EXPECT_EQ(message.step, static_cast<std::int64_t>(estimate.step));
  EXPECT_EQ(static_cast<Health>(message.health), estimate.health);
}

/// The first step has no expectations, because there is no map yet. The run has no noise, so the innovations of the
/// used bearings are small.
void expect_expectations(const test::RecordedMessages& heard) {
  ASSERT_GT(heard.expectations.size(), heard.sightings.size() / 2);
  double nis = 0.0;
  int compared = 0;
  for (const expectations_t& message : heard.expectations) {
    EXPECT_GT(message.n, 0);
    nis += message.nis;
    compared += message.compared;
  }
  ASSERT_GT(compared, 100);
  EXPECT_GT(nis, 0.0);
  EXPECT_LT(nis / compared, 0.1);
}

TEST_F(EndToEnd, PosesAreThoseOfAReplayToTheLastBit) {
  const test::RecordedMessages heard = record({"--speed", "5"});
  EXPECT_EQ(heard.undecodable, 0U);
  EXPECT_THAT(heard.foreign_channels, IsEmpty());
  std::map<std::int64_t, const Estimate*> by_stamp;
  for (const Estimate& estimate : expected_.estimates) by_stamp[to_us(estimate.stamp)] = &estimate;

  // Bearings come later than the odometry of the same instant, so a step may be older than the last prediction.
  std::int64_t last_utime[] = {-1, -1}, steps = 0;
  for (const pose_cov_t& message : heard.poses) {
    EXPECT_GT(message.utime, last_utime[message.predicted]);
    last_utime[message.predicted] = message.utime;
    if (message.predicted) continue;
    ++steps;
    ASSERT_TRUE(by_stamp.contains(message.utime));
    expect_same_bits(message, *by_stamp[message.utime]);
  }
  ASSERT_THAT(heard.statuses, testing::Not(IsEmpty()));
  ASSERT_EQ(static_cast<std::int64_t>(heard.sightings.size()), steps) << "one for each step that was published";
  EXPECT_EQ(heard.sightings.back().accepted, heard.statuses.back().accepted);
  expect_expectations(heard);
  EXPECT_EQ(steps + heard.statuses.back().estimates_replaced, static_cast<std::int64_t>(expected_.estimates.size()))
      << "every step was published, or replaced by the next and counted";
  EXPECT_GT(steps, 0);
  EXPECT_GT(static_cast<std::int64_t>(heard.poses.size()), steps) << "predictions as well";
}

TEST_F(EndToEnd, BotCorePosesSayTheSame) {
  const test::RecordedMessages heard = record({"--speed", "5"});
  ASSERT_EQ(heard.bot_poses.size(), heard.poses.size());
  for (std::size_t i = 0; i < heard.poses.size(); ++i) {
    const pose_t& bot = heard.bot_poses[i];
    const pose_cov_t& ours = heard.poses[i];
    EXPECT_EQ(bot.utime, ours.utime);
    EXPECT_EQ(bot.pos[0], ours.x_m);
    EXPECT_EQ(bot.pos[1], ours.y_m);
    EXPECT_EQ(bot.pos[2], 0.0);
    EXPECT_NEAR(wrap(2.0 * std::atan2(bot.orientation[3], bot.orientation[0]) - ours.heading_rad), 0.0, 1e-12);
    EXPECT_EQ(bot.orientation[1], 0.0);
    EXPECT_EQ(bot.orientation[2], 0.0);
  }
}

TEST_F(EndToEnd, SamplesAreEchoedUnchanged) {
  const test::RecordedMessages heard = record({"--speed", "5"});
  for (const OdometryReading& reading : heard.odometry) {
    ASSERT_LT(reading.sequence, recording_.odometry.size());
    EXPECT_EQ(reading, recording_.odometry[reading.sequence]);
  }
  for (const BearingSet& set : heard.bearings) {
    ASSERT_LT(set.sequence, recording_.bearings.size());
    const BearingSet& original = recording_.bearings[set.sequence];
    EXPECT_EQ(set.stamp, original.stamp);
    ASSERT_EQ(set.bearings.size(), original.bearings.size());
    for (std::size_t k = 0; k < set.bearings.size(); ++k) {
      EXPECT_EQ(set.bearings[k].azimuth_rad, original.bearings[k].azimuth_rad);
      EXPECT_EQ(set.bearings[k].identity, original.bearings[k].identity);
    }
  }
  const std::size_t made = recording_.odometry.size() + recording_.bearings.size();
  const std::int64_t refused = logged_number(daemon_log_, "echoes refused");
  EXPECT_EQ(static_cast<std::int64_t>(heard.odometry.size() + heard.bearings.size()) + refused,
            static_cast<std::int64_t>(made))
      << heard.odometry.size() << " readings and " << heard.bearings.size() << " sets heard; " << daemon_log_;
  EXPECT_GT(heard.bearings.size(), 0U);
}

TEST_F(EndToEnd, WhatALogNeedsToBeReplayedIsSentAtOnceAndNowAndThen) {
  const test::RecordedMessages heard = record({"--speed", "2"});  // the run then takes 7.5 s
  std::map<std::string, int> times;
  for (const document_t& document : heard.documents) {
    ++times[document.name];
    if (document.name != "rig.toml") continue;
    EXPECT_EQ(std::string(document.data.begin(), document.data.end()), test::read_text(run_ / "rig.toml"));
  }
  EXPECT_EQ(times, (std::map<std::string, int>{{"azimuth.toml", 2}, {"rig.toml", 2}, {"version", 2}}));
  const test::RecordedMessages alone = record({"--speed", "50", "--set", "daemon.lcm.echo_samples=false"});
  EXPECT_THAT(alone.documents, IsEmpty()) << "nothing could be replayed";
}

TEST_F(EndToEnd, TheLastMapAndStatusAreThoseOfTheReplay) {
  const test::RecordedMessages heard = record({"--speed", "5", "--set", "daemon.lcm.map_rate_hz=5"});
  const Estimate& last = expected_.estimates.back();
  ASSERT_GT(heard.map_chunks.size(), 2U) << "at its rate as well as at the end";
  EXPECT_LT(heard.largest_bytes, 60'000U);
  const map_chunk_t& map = heard.map_chunks.back();
  EXPECT_EQ(map.utime, to_us(last.stamp));
  EXPECT_EQ(map.chunk, 0);
  EXPECT_EQ(map.chunks, 1);
  EXPECT_EQ(map.seq, heard.map_chunks[heard.map_chunks.size() - 2].seq + 1);
  ASSERT_EQ(map.landmarks.size(), last.landmarks.size());
  for (std::size_t i = 0; i < map.landmarks.size(); ++i) {
    EXPECT_EQ(map.landmarks[i].id, last.landmarks[i].id);
    EXPECT_EQ(map.landmarks[i].identity, last.landmarks[i].identity);
    EXPECT_EQ(map.landmarks[i].x_m, last.landmarks[i].p_map_landmark_m.x());
    EXPECT_EQ(map.landmarks[i].covariance[1], last.landmarks[i].covariance_m2(0, 1));
  }

  ASSERT_FALSE(heard.paths.empty()) << "the last one at least";
  const path_t& path = heard.paths.back();
  ASSERT_EQ(path.chunks, 1);
  ASSERT_GT(path.n, 10);
  EXPECT_EQ(path.utime, path.poses.back().utime);
  EXPECT_LE(path.utime, to_us(last.stamp));

  ASSERT_GE(heard.statuses.size(), 2U) << "once a second and at the end";
  const status_t& status = heard.statuses.back();
  EXPECT_EQ(std::bit_cast<std::uint64_t>(status.estimate_digest), expected_.digest.value());
  EXPECT_EQ(status.steps, static_cast<std::int64_t>(expected_.estimates.size()));
  EXPECT_EQ(status.estimates, static_cast<std::int64_t>(heard.poses.size()));
  EXPECT_EQ(status.landmarks, static_cast<std::int32_t>(last.landmarks.size()));
  EXPECT_EQ(status.accepted, static_cast<std::int64_t>(last.association.accepted));
  EXPECT_EQ(status.odometry_refused + status.bearings_refused + status.publish_failures, 0);
  EXPECT_GT(status.utime_mono, 0);
  for (std::size_t i = 0; i < heard.statuses.size(); ++i) {
    EXPECT_EQ(heard.statuses[i].seq, static_cast<std::int64_t>(i + 1));
  }
}

TEST_F(EndToEnd, EverySpeedGivesTheSameDigest) {
  for (const char* const speed : {"max", "200", "7.5"}) {
    test::ChildProcess daemon({AZIMUTHD, "--play", run_, "--speed", speed}, folder_.path());
    EXPECT_EQ(daemon.wait(kPatience), 0);
    EXPECT_THAT(daemon.standard_error(), HasSubstr("digest " + digest_text(expected_.digest.value()))) << speed;
  }
}

TEST_F(EndToEnd, ChannelsCarryThePrefixAndPosesArePrinted) {
  const test::RecordedMessages heard =
      record({"--speed", "5", "--set", "daemon.lcm.channel_prefix=R2_", "--print-poses"}, "R2_");
  EXPECT_THAT(heard.foreign_channels, IsEmpty());
  EXPECT_THAT(heard.poses, testing::Not(IsEmpty()));
  EXPECT_THAT(daemon_output_, HasSubstr("heading"));
}

TEST_F(EndToEnd, ALostNetworkIsCountedAndEndsNothing) {
  test::ChildProcess daemon({"unshare", "-n", AZIMUTHD, "--play", run_, "--speed", "200", "--status"}, folder_.path());
  EXPECT_EQ(daemon.wait(kPatience), 0);
  const std::string error = daemon.standard_error();
  const std::string warning =
      " warning LCM udpm://239.255.76.67:7667?ttl=0: nobody will hear poses and map, since there is no network for "
      "them "
      "(see azimuth doctor): Network is unreachable; counted from here on\n";
  EXPECT_THAT(error, HasSubstr(warning));
  EXPECT_EQ(error.find(warning), error.rfind(warning)) << "logged once";
  EXPECT_THAT(error, testing::Not(HasSubstr("No route to"))) << "as liblcm says it";
  EXPECT_THAT(error, HasSubstr("digest " + digest_text(expected_.digest.value())));
}

}  // namespace
}  // namespace azimuth
