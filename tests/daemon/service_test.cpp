// azimuthd as systemd meets it: readiness, status, watchdog and stop, over a real socket.

#include <csignal>
#include <gmock/gmock.h>

#include "tests/daemon/child_process.hpp"
#include "tests/daemon/notify_socket.hpp"
#include "tests/daemon/run_files.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using ::testing::HasSubstr;

constexpr auto kPatience = 30s;

class Service : public ::testing::Test {
 protected:
  /// Starts `program` on a run that lasts for minutes, with a watchdog of 600 ms.
  std::unique_ptr<test::ChildProcess> start(const std::string& program, const std::filesystem::path& run,
                                            const std::vector<std::string>& more = {}) {
    std::vector<std::string> command{program, "--play", run, "--lcm-url", "memq://"};
    command.insert(command.end(), more.begin(), more.end());
    return std::make_unique<test::ChildProcess>(command, folder_.path(),
                                                std::vector<std::string>{socket_.variable(), "WATCHDOG_USEC=600000"});
  }

  std::filesystem::path long_run() { return test::write_run(test::small_recording(120.0), folder_.path() / "run"); }

  test::TemporaryFolder folder_;
  test::NotifySocket socket_{folder_.path()};
};

class ServiceStop : public Service, public ::testing::WithParamInterface<int> {};

TEST_P(ServiceStop, IsCleanWithinASecond) {
  const auto daemon = start(AZIMUTHD, long_run());
  ASSERT_TRUE(socket_.receives("READY=1", kPatience)) << daemon->standard_error();
  ASSERT_TRUE(socket_.receives("STATUS=t ", kPatience));
  const auto stop = Clock::now();
  daemon->signal(GetParam());
  EXPECT_EQ(daemon->wait(kPatience), 0);
  EXPECT_LT(Clock::now() - stop, 1s);
  EXPECT_TRUE(socket_.receives("STOPPING=1", 1s));
  EXPECT_THAT(daemon->standard_error(), HasSubstr("digest"));
}

INSTANTIATE_TEST_SUITE_P(Signals, ServiceStop, ::testing::Values(SIGTERM, SIGINT));

TEST_F(Service, ASignalRightAfterTheStartIsNotMissed) {
  const auto run = long_run();
  for (int round = 0; round < 10; ++round) {
    const auto daemon = start(AZIMUTHD, run);
    std::this_thread::sleep_for(std::chrono::milliseconds(3 * round));
    const auto stop = Clock::now();
    daemon->signal(SIGTERM);
    const std::optional<int> exit_code = daemon->wait(kPatience);
    EXPECT_TRUE(exit_code == 0 || exit_code == 128 + SIGTERM) << "the latter before main()";
    EXPECT_LT(Clock::now() - stop, 1s);
  }
}

TEST_F(Service, FeedsTheWatchdogWhileEveryStageRuns) {
  const auto daemon = start(AZIMUTHD, long_run());
  ASSERT_TRUE(socket_.receives("READY=1", kPatience));
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(socket_.receives("WATCHDOG=1", 600ms));
}

TEST_F(Service, AHangingStageStopsTheWatchdogFromBeingFed) {
  Recording recording = test::small_recording(120.0);
  recording.bearings[4].bearings[0].identity = test::kHangingIdentity;
  const auto run = test::write_run(recording, folder_.path() / "run");
  const auto daemon = start(FAKE_AZIMUTHD, run, {"--set", "daemon.realtime.deadline_ms=400"});
  ASSERT_TRUE(socket_.receives("WATCHDOG=1", kPatience)) << daemon->standard_error();
  ASSERT_TRUE(test::eventually(
      [&] { return daemon->standard_error().find("estimator has not finished a turn") != std::string::npos; },
      kPatience))
      << daemon->standard_error();
  socket_.drop_all();
  EXPECT_FALSE(socket_.receives("WATCHDOG=1", 1500ms));
  EXPECT_EQ(daemon->wait(0ms), std::nullopt) << "it is for the service manager to end it";
  daemon->signal(SIGTERM);
  EXPECT_EQ(daemon->wait(300ms), std::nullopt) << "it waits for the stage that hangs";
  daemon->signal(SIGTERM);
  EXPECT_EQ(daemon->wait(1s), 128 + SIGTERM) << "who asks twice means it";
}

TEST_F(Service, HoldsAfterTheEndWhenTold) {
  const auto run = test::write_run(test::small_recording(5.0), folder_.path() / "run");
  const auto daemon = start(AZIMUTHD, run, {"--speed", "max", "--hold"});
  ASSERT_TRUE(socket_.receives("READY=1", kPatience));
  EXPECT_EQ(daemon->wait(500ms), std::nullopt);
  EXPECT_TRUE(socket_.receives("WATCHDOG=1", 1s));
  daemon->signal(SIGTERM);
  EXPECT_EQ(daemon->wait(1s), 0);
}

TEST_F(Service, IsNotHeldUpByAServiceManagerThatDoesNotRead) {
  while (socket_.takes("WATCHDOG=1")) {
  }
  const auto run = test::write_run(test::small_recording(5.0), folder_.path() / "run");
  const auto daemon = start(AZIMUTHD, run, {"--speed", "max"});
  EXPECT_EQ(daemon->wait(kPatience), 0) << daemon->standard_error();
  EXPECT_THAT(daemon->standard_error(), HasSubstr("cannot notify: Resource temporarily unavailable"));
}

/// As a user without any right: the daemon runs, and says what it lacks.
TEST_F(Service, RunsWithoutRealTimeAndSaysSo) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can become nobody";
  if (std::system("setpriv --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no setpriv";
  const auto run = test::write_run(test::small_recording(120.0), folder_.path() / "run");
  std::filesystem::permissions(folder_.path(), std::filesystem::perms::all);
  std::filesystem::permissions(AZIMUTHD, std::filesystem::perms::others_exec | std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  test::ChildProcess daemon(
      {"prlimit", "--rtprio=0", "--memlock=65536", "setpriv", "--reuid=65534", "--regid=65534", "--clear-groups",
       "--inh-caps=-all", "--bounding-set=-all", AZIMUTHD, "--play", run, "--lcm-url", "memq://", "--set",
       "daemon.realtime.lock_memory=true", "--set", "daemon.realtime.estimator_fifo_priority=30", "--status"},
      folder_.path());
  const auto says = [&](const char* words) {
    return test::eventually([&] { return daemon.standard_error().find(words) != std::string::npos; }, kPatience);
  };
  if (daemon.wait(300ms)) GTEST_SKIP() << "nobody cannot run it here: " << daemon.standard_error();
  EXPECT_TRUE(says("estimator: SCHED_FIFO priority 30 refused: Operation not permitted")) << daemon.standard_error();
  EXPECT_TRUE(says("memory is not locked: the limit is 64 kB")) << daemon.standard_error();
  EXPECT_TRUE(says("  realtime: estimator: SCHED_FIFO")) << "in the status as well: " << daemon.standard_error();
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(kPatience), 0);
}

TEST_F(Service, RunsWithoutAServiceManagerAndReportsRefusals) {
  const auto run = test::write_run(test::small_recording(2.0), folder_.path() / "run");
  test::ChildProcess daemon({AZIMUTHD, "--play", run, "--lcm-url", "memq://", "--speed", "2", "--set",
                             "daemon.realtime.source_cpu=1023", "--status"},
                            folder_.path());
  EXPECT_EQ(daemon.wait(kPatience), 0);
  EXPECT_THAT(daemon.standard_error(), HasSubstr("player: CPU 1023 refused: Invalid argument"));
  EXPECT_THAT(daemon.standard_error(), HasSubstr("0 lost"));
}

}  // namespace
}  // namespace azimuth
