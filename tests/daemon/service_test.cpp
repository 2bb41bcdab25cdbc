// azimuthd under systemd: readiness, status, watchdog and stop, over a real notification socket.

#include <csignal>
#include <gmock/gmock.h>

#include "tests/daemon/daemon_process.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using ::testing::HasSubstr;

constexpr auto kPatience = 30s;

class Service : public test::DaemonProcess {
 protected:
  /// Starts `program` on `run` with a watchdog of 600 ms.
  Daemon start(const std::string& program, const std::string& run, const std::vector<std::string>& more = {}) const {
    return start_program(program, {"--play", run}, more, {"WATCHDOG_USEC=600000"});
  }
  std::string long_run() const { return write_small_run(120.0); }
};

class ServiceStop : public Service, public ::testing::WithParamInterface<int> {};

TEST_P(ServiceStop, IsCleanWithinASecond) {
  const auto daemon = start(AZIMUTHD, long_run());
  ASSERT_TRUE(socket_.receives("READY=1", kPatience)) << daemon->standard_error();
  ASSERT_TRUE(socket_.receives(" landmarks", kPatience));
  const auto stop = Clock::now();
  daemon->signal(GetParam());
  EXPECT_EQ(daemon->wait(kPatience), 0);
  EXPECT_LT(Clock::now() - stop, 1s);
  EXPECT_TRUE(socket_.receives("STOPPING=1", 1s));
  EXPECT_THAT(daemon->standard_error(), HasSubstr("digest"));
}

INSTANTIATE_TEST_SUITE_P(Signals, ServiceStop, ::testing::Values(SIGTERM, SIGINT),
                         [](const auto& signal) { return signal.param == SIGTERM ? "SIGTERM" : "SIGINT"; });

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
  const auto run = test::write_run(recording, folder_.path() / "run").string();
  const auto daemon = start(FAKE_AZIMUTHD, run, {"--set", "daemon.realtime.deadline_ms=400"});
  ASSERT_TRUE(socket_.receives("WATCHDOG=1", kPatience)) << daemon->standard_error();
  ASSERT_TRUE(says(*daemon, "estimator has not finished a turn")) << daemon->standard_error();
  socket_.drop_all();
  EXPECT_TRUE(socket_.receives("WATCHDOG=trigger", kPatience));
  EXPECT_FALSE(socket_.receives("WATCHDOG=", 1500ms)) << "neither that again nor food";
  EXPECT_EQ(daemon->wait(0ms), std::nullopt) << "it is for the service manager to end it";
  daemon->signal(SIGTERM);
  EXPECT_EQ(daemon->wait(300ms), std::nullopt) << "it waits for the stage that hangs";
  daemon->signal(SIGTERM);
  EXPECT_EQ(daemon->wait(1s), 128 + SIGTERM) << "who asks twice means it";
}

TEST_F(Service, HoldsAfterTheEndWhenTold) {
  const auto run = write_small_run(5.0);
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
  const auto run = write_small_run(5.0);
  const auto daemon = start(AZIMUTHD, run, {"--speed", "max"});
  EXPECT_EQ(daemon->wait(kPatience), 0) << daemon->standard_error();
  EXPECT_THAT(daemon->standard_error(), HasSubstr("cannot notify: Resource temporarily unavailable"));
}

/// Without privileges the daemon still runs, and reports what it lacks.
TEST_F(Service, RunsWithoutRealTimeAndSaysSo) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can become nobody";
  if (std::system("setpriv --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no setpriv";
  const auto run = write_small_run(120.0);
  std::filesystem::permissions(folder_.path(), std::filesystem::perms::all);
  std::filesystem::permissions(AZIMUTHD, std::filesystem::perms::others_exec | std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  test::ChildProcess daemon(
      {"prlimit", "--rtprio=0", "--memlock=65536", "setpriv", "--reuid=65534", "--regid=65534", "--clear-groups",
       "--inh-caps=-all", "--bounding-set=-all", AZIMUTHD, "--play", run, "--lcm-url", "memq://", "--set",
       "daemon.realtime.lock_memory=true", "--set", "daemon.realtime.estimator_fifo_priority=30", "--status"},
      folder_.path());
  if (daemon.wait(300ms)) GTEST_SKIP() << "nobody cannot run it here: " << daemon.standard_error();
  EXPECT_TRUE(says(daemon, "estimator: SCHED_FIFO priority 30 refused: Operation not permitted"))
      << daemon.standard_error();
  EXPECT_TRUE(says(daemon, "memory is not locked: the limit is 64 kB")) << daemon.standard_error();
  EXPECT_TRUE(says(daemon, "  realtime: estimator: SCHED_FIFO"))
      << "in the status as well: " << daemon.standard_error();
  daemon.signal(SIGTERM);
  EXPECT_EQ(daemon.wait(kPatience), 0);
}

TEST_F(Service, RunsWithoutAServiceManagerAndReportsRefusals) {
  const auto run = write_small_run(2.0);
  test::ChildProcess daemon({AZIMUTHD, "--play", run, "--lcm-url", "memq://", "--speed", "2", "--set",
                             "daemon.realtime.source_cpu=1023", "--status"},
                            folder_.path());
  EXPECT_EQ(daemon.wait(kPatience), 0);
  EXPECT_THAT(daemon.standard_error(), HasSubstr("player: CPU 1023 refused: Invalid argument"));
  EXPECT_THAT(daemon.standard_error(), HasSubstr("0 lost"));
}

}  // namespace
}  // namespace azimuth
