// The field log cannot grow. Subscribers are told, poses continue, and the log resumes when there is room. Run by
// in_namespace.sh, so that LCM messages do not leave the test.

#include <azimuth/pose_cov_t.hpp>
#include <azimuth/status_t.hpp>
#include <cerrno>
#include <cstring>
#include <gmock/gmock.h>
#include <lcm/lcm-cpp.hpp>
#include <sys/resource.h>

#include "drivers/storage/session.hpp"
#include "drivers/wire/channels.hpp"
#include "tests/live/live.hpp"

namespace azimuth {
namespace {

using testing::HasSubstr;

constexpr char kUrl[] = "udpm://239.255.76.67:7667?ttl=0";
constexpr rlim_t kSmallFile_bytes = 30'000;  // some seconds of recording
constexpr std::int64_t kPosesMeanwhile = 20;

/// Receives the daemon's messages, as other programs do.
class Listener {
 public:
  Listener() {
    // Functions instead of members: GCC 12's UBSan falsely reports a null pointer in LCM's own call of a member.
    lcm_.subscribeFunction(std::string(channel::kStatus), hear_status, this);
    lcm_.subscribeFunction(std::string(channel::kPose), hear_pose, this);
  }

  /// Listens until the condition is true; returns false on a timeout.
  template <class Condition>
  bool until(const Condition& condition) {
    constexpr int kWait_ms = 50;
    return test::eventually([&] { return lcm_.handleTimeout(kWait_ms) >= 0 && condition(); }, test::kPatience);
  }

  status_t last_status{};
  pose_cov_t last_pose{};
  std::int64_t poses = 0;

 private:
  static void hear_status(const lcm::ReceiveBuffer*, const std::string&, const status_t* status, Listener* self) {
    self->last_status = *status;
  }
  static void hear_pose(const lcm::ReceiveBuffer*, const std::string&, const pose_cov_t* pose, Listener* self) {
    self->last_pose = *pose;
    ++self->poses;
  }

  lcm::LCM lcm_{kUrl};
};

/// Makes writes beyond `bytes` fail, as on a full disk, but for this process only.
void limit_files(pid_t pid, rlim_t bytes) {
  const rlimit limit{.rlim_cur = bytes, .rlim_max = RLIM_INFINITY};
  ASSERT_EQ(::prlimit(pid, RLIMIT_FSIZE, &limit, nullptr), 0) << std::strerror(errno);
}

class FullDisk : public test::Live {};

TEST_F(FullDisk, StopsTheLogAndNothingElse) {
  Listener listener;
  const test::Robot robot(folder());
  test::Daemon daemon(folder(), rig_, {"--record", records()}, kUrl);
  ASSERT_NO_FATAL_FAILURE(limit_files(daemon.pid(), kSmallFile_bytes));
  const auto recorder_says = [&](const std::string& words) {
    return listener.until([&] { return listener.last_status.recorder.find(words) != std::string::npos; });
  };
  ASSERT_TRUE(recorder_says("cannot be written: File too large")) << listener.last_status.recorder;

  const std::int64_t poses = listener.poses, steps = listener.last_pose.step;
  EXPECT_TRUE(listener.until([&] { return listener.poses > poses + kPosesMeanwhile; }));
  EXPECT_TRUE(listener.until([&] { return listener.last_pose.step > steps; }));
  EXPECT_EQ(listener.last_pose.health, pose_cov_t::HEALTH_TRACKING);
  EXPECT_TRUE(listener.until([&] { return listener.last_status.record_losses > 0; }));
  EXPECT_THAT(daemon.standard_error(), HasSubstr("recording stopped: "));

  ASSERT_NO_FATAL_FAILURE(limit_files(daemon.pid(), RLIM_INFINITY));
  EXPECT_TRUE(listener.until([&] { return listener.last_status.recorder.ends_with(".lcm"); }))
      << listener.last_status.recorder;
  const std::int64_t resumed_us = listener.last_pose.utime;
  EXPECT_TRUE(listener.until([&] { return listener.last_pose.utime > resumed_us + 1'000'000; }));
  EXPECT_EQ(daemon.stop(), 0);

  const std::filesystem::path session = test::only_session(records());
  EXPECT_GE(session_segments(session).size(), 2U);
  const FileResult<azimuth::Run> run = load_run(session);
  ASSERT_TRUE(run) << text(run.error());
  EXPECT_EQ(run->skipped.damaged_bytes, 0U);
  EXPECT_GT(run->skipped.unrecorded_events, 0U) << "the log says what it lacks";
  EXPECT_GT(to_us(run->odometry.back().stamp), resumed_us) << "and goes on afterwards";
}

}  // namespace
}  // namespace azimuth
