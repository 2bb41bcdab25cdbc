// A daemon that is stopped or killed and restarted while its robot drives on: it still knows the robot's pose.

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <numeric>
#include <random>
#include <sys/resource.h>
#include <thread>
#include <vector>

#include "drivers/storage/kept_odometry.hpp"
#include "drivers/storage/map_file.hpp"
#include "tests/live/live.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::seconds kSaveInterval{5};
constexpr Duration kPosesAgain = 3s;
constexpr double kThreeSigmaChi2 = 14.16, kFourSigmaChi2 = 22.06;  // 99.73 and 99.994 % of three dimensions

/// The number of repetitions from an environment variable, or the default `otherwise`.
int times(const char* variable, int otherwise) {
  const char* const wanted = std::getenv(variable);
  return wanted ? std::max(2, std::atoi(wanted)) : otherwise;
}

int restarts() { return times("AZIMUTH_RESTARTS", 6); }

Stamp now() {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  return Stamp{std::chrono::duration_cast<Duration>(since_epoch)};
}

Pose2 map_pose_of(const pose_cov_t& pose) { return {pose.x_m, pose.y_m, pose.heading_rad}; }

double chi2(const Pose2& T_map_true, const pose_cov_t& pose) {
  Eigen::Vector3d error = map_pose_of(pose).vector() - T_map_true.vector();
  error.z() = wrap(error.z());
  const Eigen::Map<const Eigen::Matrix3d> covariance(pose.covariance);
  return error.dot(covariance.ldlt().solve(error));
}

class Restarts : public test::Live {
 protected:
  std::filesystem::path map() const { return folder() / "state/map.azmap"; }
  std::filesystem::path session(int start) const { return test::only_session(records() / std::to_string(start)); }
  std::unique_ptr<test::Daemon> daemon(int start, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> options{"--status",
                                     "--record",
                                     records() / std::to_string(start),
                                     "--set",
                                     "daemon.map.file=" + map().string(),
                                     "--set",
                                     fmt::format("daemon.map.save_interval_s={}", kSaveInterval.count())};
    options.insert(options.end(), more.begin(), more.end());
    return std::make_unique<test::Daemon>(folder(), rig_, options);
  }
};

/// The first pose of a session and its error relative to the robot's true pose.
struct FirstPose {
  pose_cov_t pose;
  Stamp stamp{};
  double chi2 = 0.0;
};

FirstPose first_pose(const std::filesystem::path& first_session, const std::filesystem::path& session,
                     const azimuth::Run& truth) {
  const pose_cov_t origin = test::published(first_session).poses.front();
  const Pose2 T_map_world = map_pose_of(origin) * inverse(test::true_pose(truth, stamp_from_us(origin.utime)));
  const pose_cov_t first = test::published(session).poses.front();
  const Stamp stamp = stamp_from_us(first.utime);
  return {first, stamp, chi2(T_map_world * test::true_pose(truth, stamp), first)};
}

/// The circumstances of one start.
struct Start {
  Stamp ended{};  ///< When the last process before it ended
  bool was_killed = false;
};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

TEST_F(Restarts, KnowWhereTheRobotIsAtOnce) {
  // GIVEN a robot that is tracked, and a map of its surroundings
  test::Robot robot(folder());
  auto running = daemon(0);
  ASSERT_TRUE(running->has_landmarks(8)) << running->standard_error();
  ASSERT_TRUE(running->logs("the map is saved to")) << running->standard_error();
  // WHEN its daemon ends again and again, every other time by SIGKILL, and is restarted at once. Now and then the
  // restarted daemon is killed as well, before or after it has received odometry.
  std::mt19937_64 random(13);
  std::uniform_int_distribution<int> life_ms(1500, 4000), short_life_ms(0, 1000);
  std::vector<Start> starts(static_cast<std::size_t>(restarts()));
  int kills = 0, early_kills = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const int start = static_cast<int>(i) + 1;
    starts[i].was_killed = start % 2 == 0;
    starts[i].ended = now();
    if (starts[i].was_killed) {
      running->kill();
      ++kills;
    } else {
      ASSERT_EQ(running->stop(), 0);
    }
    if (start % 5 == 0) {
      running = daemon(-start);
      std::this_thread::sleep_for(std::chrono::milliseconds(short_life_ms(random)));
      starts[i] = {.ended = now(), .was_killed = true};
      running->kill();
      ++early_kills;
    }
    running = daemon(start);
    ASSERT_TRUE(running->logs("before the start")) << "start " << start << ": " << running->standard_error();
    ASSERT_TRUE(running->logs("odometry goes on from before the start"))
        << "start " << start << ": " << running->standard_error();
    std::this_thread::sleep_for(std::chrono::milliseconds(life_ms(random)));
  }
  ASSERT_EQ(running->stop(), 0);
  ASSERT_EQ(robot.end(), 0);
  // THEN poses resume soon, and the first one agrees with the robot's true pose
  const azimuth::Run truth = robot.truth();
  std::vector<double> away_s, off;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const int start = static_cast<int>(i) + 1;
    const test::FieldLog log(session(start));
    EXPECT_TRUE(log.verification.passed()) << "start " << start << ": " << log.verification.text();
    EXPECT_GT(log.verification.recorded, 3U) << "start " << start;
    const FirstPose first = first_pose(session(0), session(start), truth);
    EXPECT_NE(first.pose.health, pose_cov_t::HEALTH_LOST) << "start " << start;
    away_s.push_back(to_seconds(first.stamp - starts[i].ended));
    EXPECT_LT(first.stamp - starts[i].ended, kPosesAgain) << "start " << start;
    off.push_back(first.chi2);
    EXPECT_LT(off.back(), kThreeSigmaChi2) << "start " << start << (starts[i].was_killed ? ", after a kill" : "");
  }
  fmt::print(
      "{} restarts after {} stops and {} kills, {} more killed within a second: first pose: chi2 {:.2f} (mean), {:.2f} "
      "(median), {:.2f} at worst, after {:.2f} s (median), {:.2f} s at worst\n",
      starts.size(), static_cast<int>(starts.size()) - kills, kills, early_kills,
      std::accumulate(off.begin(), off.end(), 0.0) / static_cast<double>(off.size()), median(off),
      std::ranges::max(off), median(away_s), std::ranges::max(away_s));
}

/// The reason why a start could not continue from the files on the disk; empty if it could.
std::string why_no_pair(const std::filesystem::path& file) {
  const FileResult<LoadedMap> map = read_map(file);
  if (!map) return text(map.error());
  const std::uint32_t checksum = map_checksum(map->bytes);
  std::string found = fmt::format("map {:08x}, records", checksum);
  for (const auto& kept : read_kept_odometry(kept_odometry_file(file))) {
    if (kept && kept->map_checksum == checksum && kept->since.map == map->map.stamp) return {};
    found += kept ? fmt::format(" {:08x}", kept->map_checksum) : " none";
  }
  return found;
}

/// Daemons that are killed twice in quick succession while their robot drives on.
class KilledTwice : public Restarts {
 protected:
  /// Checks the first pose of each start that had one against the robot's true pose.
  void expect_first_poses_right(int starts, const azimuth::Run& truth) const {
    std::vector<double> off;
    for (int start = 1; start <= starts; ++start) {
      if (!std::filesystem::exists(records() / std::to_string(start))) continue;  // killed before it began a session
      if (test::published(session(start)).poses.empty()) continue;
      const FirstPose first = first_pose(session(0), session(start), truth);
      EXPECT_NE(first.pose.health, pose_cov_t::HEALTH_LOST) << "start " << start;
      off.push_back(first.chi2);
      EXPECT_LT(off.back(), kFourSigmaChi2) << "start " << start;
    }
    // By chance one pose in 370 is farther off than three standard deviations.
    const auto outside = std::ranges::count_if(off, [](double chi2) { return chi2 >= kThreeSigmaChi2; });
    EXPECT_LE(outside, 1 + starts / 200);
    EXPECT_GE(off.size(), static_cast<std::size_t>(starts / 2));
    fmt::print("{} of {} starts had a pose before they were killed: chi2 {:.2f} (median), {:.2f} at worst\n",
               off.size(), starts, median(off), std::ranges::max(off));
  }
};

TEST_F(KilledTwice, LeavesAMapAndTheWaySinceIt) {
  test::Robot robot(folder());
  auto running = daemon(0);
  ASSERT_TRUE(running->has_landmarks(8)) << running->standard_error();
  ASSERT_TRUE(running->logs("the map is saved to")) << running->standard_error();
  std::mt19937_64 random(17);
  std::uniform_int_distribution<int> life_ms(1500, 4000), short_life_ms(0, 1500);
  const int kills = times("AZIMUTH_KILLS", 20);
  int whole = 0;
  for (int kill = 1; kill <= kills; ++kill) {
    const bool is_second = kill % 2 == 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(is_second ? short_life_ms(random) : life_ms(random)));
    running->kill();
    const std::string why = why_no_pair(map());
    EXPECT_EQ(why, "") << "kill " << kill;
    whole += why.empty() ? 1 : 0;
    running = daemon(kill);
    if (!is_second) continue;
    ASSERT_TRUE(running->has_odometry()) << "kill " << kill << ": " << running->standard_error();
  }
  std::this_thread::sleep_for(1s);
  running->kill();
  ASSERT_EQ(robot.end(), 0);
  fmt::print("the pair was whole after {} of {} kills\n", whole, kills);
  expect_first_poses_right(kills, robot.truth());
}

TEST_F(Restarts, KnowWhereTheRobotIsThoughNoMapCouldBeSavedForLong) {
  // GIVEN a robot that is tracked, and a disk on which its map cannot be written any more
  test::Robot robot(folder());
  auto running = daemon(0);
  ASSERT_TRUE(running->has_landmarks(14)) << running->standard_error();
  ASSERT_TRUE(running->logs("the map is saved to")) << running->standard_error();
  constexpr rlim_t kNoMap_bytes = 4096;
  const rlimit limit{.rlim_cur = kNoMap_bytes, .rlim_max = RLIM_INFINITY};
  ASSERT_EQ(::prlimit(running->pid(), RLIMIT_FSIZE, &limit, nullptr), 0);
  ASSERT_TRUE(running->logs("the map is not saved")) << running->standard_error();
  // WHEN the robot drives on for longer than a relocalisation takes, and the daemon is killed
  std::this_thread::sleep_for(3 * kSaveInterval);
  const Stamp killed = now();
  running->kill();
  // THEN the odometry on the disk is less than a second old, and the next start continues from it
  EXPECT_EQ(why_no_pair(map()), "");
  const KeptRecords kept = read_kept_odometry(kept_odometry_file(map()));
  const auto is_fresh = [&](const auto& record) { return record && killed - record->since.reading.stamp < 1s; };
  EXPECT_TRUE(std::ranges::any_of(kept, is_fresh));
  running = daemon(1);
  EXPECT_TRUE(running->logs("odometry goes on from before the start")) << running->standard_error();
  std::this_thread::sleep_for(1s);
  EXPECT_EQ(running->stop(), 0);
  ASSERT_EQ(robot.end(), 0);
  const FirstPose first = first_pose(session(0), session(1), robot.truth());
  EXPECT_NE(first.pose.health, pose_cov_t::HEALTH_LOST);
  EXPECT_LT(first.chi2, kThreeSigmaChi2);
}

TEST_F(Restarts, KnowWhereTheRobotIsOnAMapThatStaysAsItIs) {
  // GIVEN a map, and a robot whose controller has been restarted since
  test::Robot robot(folder());
  auto running = daemon(0);
  ASSERT_TRUE(running->has_landmarks(16)) << running->standard_error();
  ASSERT_EQ(running->stop(), 0);
  const std::vector<std::byte> before = read_map_only(map())->bytes;
  robot.obey("reboot=0xFF");
  // WHEN its daemon only localises, and has relocalised the robot
  const std::vector<std::string> localise{"--set", "map.mode=localise"};
  running = daemon(1, localise);
  ASSERT_TRUE(running->logs("odometry does not go on from before the start")) << running->standard_error();
  const auto is_kept = [&] {
    const KeptRecords kept = read_kept_odometry(kept_odometry_file(map()));
    return std::filesystem::exists(located_map(map())) && (kept[0] || kept[1]);
  };
  ASSERT_TRUE(test::eventually(is_kept, test::kPatience)) << running->standard_error();
  std::this_thread::sleep_for(kSaveInterval);
  running->kill();
  // THEN the daemon knows the pose after a kill and after a stop
  for (const int start : {2, 3}) {
    running = daemon(start, localise);
    ASSERT_TRUE(running->logs("before the start")) << running->standard_error();
    EXPECT_TRUE(running->logs("odometry goes on from before the start")) << running->standard_error();
    std::this_thread::sleep_for(1s);
    EXPECT_EQ(running->stop(), 0);
  }
  ASSERT_EQ(robot.end(), 0);
  for (const int start : {2, 3}) {
    const test::FieldLog log(session(start));
    EXPECT_TRUE(log.verification.passed()) << log.verification.text();
    const FirstPose first = first_pose(session(0), session(start), robot.truth());
    EXPECT_NE(first.pose.health, pose_cov_t::HEALTH_LOST);
    EXPECT_LT(first.chi2, kThreeSigmaChi2);
  }
  EXPECT_EQ(read_map_only(map())->bytes, before);
}

TEST_F(Restarts, SearchForARobotWhoseControllerWasRestartedMeanwhile) {
  test::Robot robot(folder());
  auto running = daemon(0);
  ASSERT_TRUE(running->has_landmarks(16)) << running->standard_error();
  std::this_thread::sleep_for(kSaveInterval + 1s);
  running->kill();
  robot.obey("reboot=0xFF");
  running = daemon(1);
  EXPECT_TRUE(running->logs("odometry does not go on from before the start")) << running->standard_error();
  EXPECT_TRUE(running->logs("tracking")) << "it is found: " << running->standard_error();
  EXPECT_EQ(running->stop(), 0);
  const test::FieldLog log(session(1));
  EXPECT_TRUE(log.verification.passed()) << log.verification.text();
  EXPECT_EQ(test::published(session(1)).poses.front().health, pose_cov_t::HEALTH_LOST);
}

}  // namespace
}  // namespace azimuth
