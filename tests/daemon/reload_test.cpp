// azimuthd as a process, which reads its configuration anew on SIGHUP.

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
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr auto kReloadPatience = 60s;
// Of the six landmarks, one may still be without a known distance when the map is saved.
constexpr std::size_t kFewestSaved = 5;

class Reload : public test::DaemonProcess {
 protected:
  /// Configures the daemon to play a run of several minutes at five times its speed.
  void configure(const std::string& more = {}) {
    test::write_text(file_, "[daemon.play]\nrun = \"" + run_ + "\"\nspeed = 5\n" + more);
  }
  Daemon start(const char* program = AZIMUTHD, const std::vector<std::string>& more = {}) const {
    Daemon daemon = start_program(program, {"--config", file_}, more);
    EXPECT_TRUE(socket_.receives("READY=1", kReloadPatience)) << daemon->standard_error();
    return daemon;
  }
  bool maps_all() const { return socket_.receives(" 6 landmarks", kReloadPatience); }
  /// Sends SIGTERM and returns the exit code.
  static std::optional<int> end_of(test::ChildProcess& daemon) {
    daemon.signal(SIGTERM);
    return daemon.wait(kReloadPatience);
  }

  std::string run_ = write_small_run(600.0);
  std::string file_ = (folder_.path() / "azimuthd.toml").string();
};

TEST_F(Reload, GoesOnWithTheMapThroughMemory) {
  configure();
  const auto daemon = start();
  ASSERT_TRUE(maps_all()) << daemon->standard_error();
  configure("[map]\npose_known = true\n[daemon]\nlog_level = \"warning\"\n");
  daemon->signal(SIGHUP);
  ASSERT_TRUE(socket_.receives("RELOADING=1\nMONOTONIC_USEC=", kReloadPatience));
  ASSERT_TRUE(socket_.receives("READY=1", kReloadPatience)) << daemon->standard_error();
  EXPECT_TRUE(maps_all()) << "at once, and none twice";
  const std::string before = daemon->standard_error();
  EXPECT_EQ(end_of(*daemon), 0);
  EXPECT_THAT(before, HasSubstr("SIGHUP"));
  EXPECT_EQ(daemon->standard_error(), before) << "warnings only, from then on";
}

TEST_F(Reload, SaysThatTheMapGoesOn) {
  configure();
  const auto daemon = start();
  ASSERT_TRUE(maps_all()) << daemon->standard_error();
  daemon->signal(SIGHUP);
  EXPECT_TRUE(says(*daemon, "map: goes on with its ")) << daemon->standard_error();
  EXPECT_THAT(daemon->standard_error(), HasSubstr("the configuration has been read anew"));
  EXPECT_EQ(end_of(*daemon), 0);
}

TEST_F(Reload, KeepsWhatWasInForceWhenAnythingIsWrongAndNamesIt) {
  configure();
  const auto daemon = start();
  ASSERT_TRUE(maps_all()) << daemon->standard_error();
  configure("[ekf]\ngate_chi = 1\n[daemon.lmc]\n");
  daemon->signal(SIGHUP);
  ASSERT_TRUE(socket_.receives("RELOADING=1", kReloadPatience));
  EXPECT_TRUE(socket_.receives("READY=1\nSTATUS=configuration refused: ", kReloadPatience)) << daemon->standard_error();
  EXPECT_TRUE(socket_.receives("  configuration: " + file_ + ":5", kReloadPatience)) << "the status keeps saying so";
  EXPECT_THAT(daemon->standard_error(),
              AllOf(HasSubstr("unknown key 'gate_chi'"), HasSubstr("unknown section [daemon.lmc]"),
                    HasSubstr("the configuration is as it was before SIGHUP"), Not(HasSubstr("digest"))));
  // The corrected configuration is accepted.
  configure();
  daemon->signal(SIGHUP);
  EXPECT_TRUE(says(*daemon, "goes on with its ")) << daemon->standard_error();
  socket_.drop_all();
  std::string status;
  while (status.find(" landmarks") == std::string::npos)
    ASSERT_FALSE((status = socket_.receive(kReloadPatience)).empty());
  EXPECT_THAT(status, Not(HasSubstr("configuration:")));
  EXPECT_EQ(end_of(*daemon), 0);
}

TEST_F(Reload, ARigOrRecordingThatIsGoneIsRefusedToo) {
  configure();
  const auto daemon = start();
  test::write_text(run_ + "/rig.toml", "[camera]\nsigma_bearing_deg = 2.5\n");
  daemon->signal(SIGHUP);
  EXPECT_TRUE(says(*daemon, "sigma_bearing_rad")) << daemon->standard_error();
  std::filesystem::remove(file_);
  daemon->signal(SIGHUP);
  EXPECT_TRUE(says(*daemon, "azimuthd.toml: cannot be read")) << daemon->standard_error();
  EXPECT_EQ(end_of(*daemon), 0);
}

TEST_F(Reload, StartsFromNothingWhereTheNewEstimatorCannotUseTheMap) {
  configure();
  const auto daemon = start();
  ASSERT_TRUE(maps_all()) << daemon->standard_error();
  configure("[daemon.map]\nfile = \"" + (folder_.path() / "map.azmap").string() + "\"\n");
  test::write_text(file_, "estimator = \"fastslam\"\n" + test::read_text(file_));
  daemon->signal(SIGHUP);
  EXPECT_TRUE(says(*daemon, "mapping starts from nothing: its landmarks have no heights")) << daemon->standard_error();
  EXPECT_EQ(end_of(*daemon), 0);
}

TEST_F(Reload, AStormOfThemEndsNothing) {
  configure();
  const auto daemon = start();
  ASSERT_TRUE(maps_all()) << daemon->standard_error();
  for (int i = 0; i < 300; ++i) {
    daemon->signal(SIGHUP);
    if (i % 50 == 0) configure(i % 100 == 0 ? "[no such table\n" : "");
    std::this_thread::sleep_for(2ms);
    socket_.drop_all();
  }
  configure();
  daemon->signal(SIGHUP);
  socket_.drop_all();
  EXPECT_TRUE(maps_all()) << "no landmark lost or twice: " << daemon->standard_error();
  EXPECT_EQ(end_of(*daemon), 0);
}

TEST_F(Reload, AStopMeanwhileIsObeyedInOrder) {
  const std::string map = (folder_.path() / "map.azmap").string();
  configure("[daemon.map]\nfile = \"" + map + "\"\n");
  for (int round = 0; round < 10; ++round) {
    socket_.drop_all();
    const auto daemon = start();
    ASSERT_TRUE(maps_all()) << daemon->standard_error();
    daemon->signal(SIGHUP);
    std::this_thread::sleep_for(std::chrono::milliseconds(2 * round));
    EXPECT_EQ(end_of(*daemon), 0) << daemon->standard_error();
    const auto saved = read_map_only(map);
    ASSERT_TRUE(saved);
    EXPECT_GE(saved->map.landmarks.size(), kFewestSaved);
  }
}

TEST_F(Reload, DuringAStopChangesNothing) {
  configure();
  const auto daemon = start();
  daemon->signal(SIGTERM);
  for (int i = 0; i < 20; ++i) {
    daemon->signal(SIGHUP);
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_EQ(daemon->wait(kReloadPatience), 0);
}

TEST_F(Reload, BeginsASessionOfItsOwnThatAReplayRepeats) {
  const std::string records = (folder_.path() / "records").string();
  configure("[daemon.record]\nfolder = \"" + records + "\"\n");
  const auto daemon = start();
  ASSERT_TRUE(maps_all()) << daemon->standard_error();
  configure("[ekf]\nthinning_s = 0.8\n[daemon.record]\nfolder = \"" + records + "\"\n");
  daemon->signal(SIGHUP);
  ASSERT_TRUE(socket_.receives("READY=1", kReloadPatience));
  ASSERT_TRUE(maps_all()) << daemon->standard_error();
  EXPECT_EQ(end_of(*daemon), 0);
  std::vector<std::filesystem::path> sessions;
  for (const auto& entry : std::filesystem::directory_iterator(records)) sessions.push_back(entry.path());
  std::ranges::sort(sessions);
  ASSERT_EQ(sessions.size(), 2u);
  std::string logged = daemon->standard_error();
  for (const std::filesystem::path& session : sessions) {
    const FileResult<azimuth::Run> run = load_run(session);
    ASSERT_TRUE(run) << text(run.error());
    MapSnapshot map;
    if (!run->map.empty()) {
      ASSERT_FALSE(decode_map(std::as_bytes(std::span(run->map)), map));
    }
    if (session == sessions[1])
      EXPECT_GE(map.landmarks.size(), kFewestSaved) << "what the second began with";
    else
      EXPECT_TRUE(map.landmarks.empty());
    const auto configuration = read_configuration(run->configuration_toml, "azimuth.toml");
    ASSERT_TRUE(configuration);
    const auto rig = read_rig(run->rig_toml, "rig.toml");
    const test::Replayed replayed =
        test::replay({run->odometry, run->bearings},
                     configured_estimator(*rig, *configuration, run->map.empty() ? nullptr : &map), *rig);
    const std::string digest = "digest " + digest_text(replayed.digest.value());
    ASSERT_THAT(logged, HasSubstr(digest));
    logged.erase(0, logged.find(digest) + digest.size());  // the digests come in this order
  }
}

TEST_F(Reload, WaitsForNoStageThatHangs) {
  Recording recording = test::small_recording(120.0);
  recording.bearings[4].bearings[0].identity = test::kHangingIdentity;
  run_ = test::write_run(recording, folder_.path() / "hanging").string();
  configure();
  const auto daemon = start(FAKE_AZIMUTHD, {"--set", "daemon.realtime.deadline_ms=400"});
  ASSERT_TRUE(says(*daemon, "estimator has not finished a turn")) << daemon->standard_error();
  daemon->signal(SIGHUP);
  EXPECT_TRUE(says(*daemon, "estimator hangs, so nothing is read")) << daemon->standard_error();
}

}  // namespace
}  // namespace azimuth
