// azimuthd restarted with the map that it saved.

#include <csignal>
#include <gmock/gmock.h>

#include "drivers/storage/map_file.hpp"
#include "settings/configured_estimator.hpp"
#include "settings/rig.hpp"
#include "tests/daemon/daemon_process.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using ::testing::HasSubstr;

constexpr auto kRestartPatience = 60s;

class Restart : public test::DaemonProcess {
 protected:
  Daemon start(const std::vector<std::string>& more) const {
    return start_program(AZIMUTHD, {"--play", run_, "--set", "daemon.map.file=" + map_}, more);
  }
  static std::optional<int> end_of(test::ChildProcess& daemon) { return daemon.wait(kRestartPatience); }
  /// Plays the recording to its end and returns the daemon's log.
  std::string run_to_the_end(const std::vector<std::string>& more = {}) {
    std::vector<std::string> options{"--speed", "max"};
    options.insert(options.end(), more.begin(), more.end());
    const auto daemon = start(options);
    EXPECT_EQ(end_of(*daemon), 0) << daemon->standard_error();
    return daemon->standard_error();
  }

  std::string run_ = write_small_run(60.0);
  std::string map_ = (folder_.path() / "state" / "map.azmap").string();
};

TEST_F(Restart, GoesOnFromTheMapOfTheDayBefore) {
  EXPECT_THAT(run_to_the_end(), HasSubstr("not there yet"));
  const auto first = read_map(map_);
  ASSERT_TRUE(first);
  EXPECT_THAT(run_to_the_end(), HasSubstr("started from its 6 landmarks"));
  const auto second = read_map(map_);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->map.landmarks.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(second->map.landmarks[i].id, first->map.landmarks[i].id) << "landmarks keep their numbers";
    EXPECT_GT(second->map.landmarks[i].sightings, first->map.landmarks[i].sightings);
  }
  EXPECT_TRUE(read_map_only(previous_map(map_)));
}

TEST_F(Restart, IsRecordedSoThatAReplayGivesTheSameBits) {
  run_to_the_end();
  const std::string bytes_before = [&] {
    const auto map = read_map(map_);
    return std::string(reinterpret_cast<const char*>(map->bytes.data()), map->bytes.size());
  }();
  const std::string records = (folder_.path() / "records").string();
  const std::string logged = run_to_the_end({"--set", "daemon.record.folder=" + records, "--set",
                                             "map.sigma_position_m=0.5", "--set", "map.pose_known=true"});
  // GIVEN the field log of a daemon that started from a map
  const FileResult<azimuth::Run> run = load_run(std::filesystem::directory_iterator(records)->path());
  ASSERT_TRUE(run) << text(run.error());
  EXPECT_EQ(run->map, bytes_before) << "the very file, which the daemon has overwritten since";
  // WHEN the log is replayed with the map and the documents it contains
  MapSnapshot map;
  ASSERT_FALSE(decode_map(std::as_bytes(std::span(run->map)), map));
  const auto configuration = read_configuration(run->configuration_toml, "azimuth.toml");
  ASSERT_TRUE(configuration);
  EXPECT_EQ(configuration->map.sigma_position_m, 0.5);
  const auto rig = read_rig(run->rig_toml, "rig.toml");
  const test::Replayed replayed =
      test::replay({run->odometry, run->bearings}, configured_estimator(*rig, *configuration, &map), *rig);
  // THEN the estimates are the same to the last bit
  EXPECT_THAT(logged, HasSubstr("digest " + digest_text(replayed.digest.value())));
}

TEST_F(Restart, IsTrackingWithinSecondsAfterItWasKilled) {
  // GIVEN a daemon that was killed while it drove
  {
    const auto daemon = start({"--speed", "5", "--set", "daemon.map.save_interval_s=0.3"});
    const auto has_seen_all = [&] {
      const auto map = read_map(map_);
      return map && map->map.landmarks.size() == 6;
    };
    ASSERT_TRUE(test::eventually(has_seen_all, kRestartPatience)) << daemon->standard_error();
    daemon->signal(SIGKILL);
    EXPECT_EQ(end_of(*daemon), 128 + SIGKILL);
  }
  // WHEN the daemon is restarted and does not know its pose
  socket_.drop_all();
  const auto begin = Clock::now();
  const auto daemon = start({});
  // THEN it tracks again
  bool tracking = false;
  while (!tracking && Clock::now() - begin < kRestartPatience) tracking = socket_.receives("tracking", 1s);
  EXPECT_TRUE(tracking) << daemon->standard_error();
  EXPECT_LT(Clock::now() - begin, 10s);
}

TEST_F(Restart, UsesTheMapBeforeADamagedOneAndSaysSo) {
  run_to_the_end();
  run_to_the_end();
  test::write_text(map_, "azimuth map\nwhich somebody edited");
  const std::string logged = run_to_the_end();
  EXPECT_THAT(logged, HasSubstr(map_ + ": is cut short"));
  EXPECT_THAT(logged, HasSubstr(map_ + ".previous: started from its 6 landmarks"));
  EXPECT_TRUE(read_map_only(map_)) << "a good one again";
}

TEST_F(Restart, MapsFromNothingWhenNoMapCanBeReadButDoesNotLocaliseThen) {
  std::filesystem::create_directories(folder_.path() / "state");
  test::write_text(map_, "no map at all");
  const auto localising = start({"--set", "map.mode=localise"});
  EXPECT_EQ(end_of(*localising), 2);
  EXPECT_THAT(localising->standard_error(), HasSubstr("localise"));
  EXPECT_THAT(run_to_the_end(), HasSubstr("mapping starts from nothing"));
  EXPECT_TRUE(read_map_only(map_));
  EXPECT_TRUE(std::filesystem::exists(map_ + ".refused")) << "nothing is thrown away";
}

TEST_F(Restart, RefusesAMapOfAnotherKind) {
  run_to_the_end();
  const auto daemon = start({"--set", "estimator=fastslam"});
  EXPECT_EQ(end_of(*daemon), 2);
  EXPECT_THAT(daemon->standard_error(),
              HasSubstr("its landmarks have no heights, and estimator \"fastslam\" maps in space"));
}

}  // namespace
}  // namespace azimuth
