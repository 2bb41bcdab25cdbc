// A recorder killed by SIGKILL at any instant leaves a log that is complete up to the last flush and can be replayed.

#include <atomic>
#include <csignal>
#include <gtest/gtest.h>
#include <random>
#include <sched.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/daemon/record/recording.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr int kKills = 200;
constexpr std::uint64_t kLongestLife = 4000;  // number of readings

/// A number shared by the parent and the child process.
class SharedCount {
 public:
  SharedCount()
      : count_(static_cast<std::atomic<std::uint64_t>*>(
            ::mmap(nullptr, sizeof(std::uint64_t), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))) {}
  SharedCount(const SharedCount&) = delete;
  SharedCount& operator=(const SharedCount&) = delete;
  ~SharedCount() { ::munmap(count_, sizeof(std::uint64_t)); }
  std::atomic<std::uint64_t>& operator*() { return *count_; }

 private:
  std::atomic<std::uint64_t>* count_;
};

[[noreturn]] void record_until_killed(const RecordSettings& settings, std::atomic<std::uint64_t>& fed) {
  test::Feeder feeder(settings);
  for (;;) {
    feeder.feed(1);
    fed.store(feeder.readings());
  }
}

/// Lets a child process record until it has been fed about `life` readings, and kills it. Returns the number of
/// readings it was fed.
std::uint64_t readings_until_killed(const RecordSettings& settings, std::uint64_t life) {
  SharedCount fed;
  const pid_t child = ::fork();
  if (child == 0) record_until_killed(settings, *fed);
  while (*fed < life) ::sched_yield();
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  return *fed;
}

TEST(Kill, LosesLessThanASecondAndNothingBefore) {
  std::mt19937_64 random(7);
  std::size_t segments = 0, cut_events = 0;
  for (int kill = 0; kill < kKills; ++kill) {
    const test::TemporaryFolder folder;
    RecordSettings settings;
    settings.folder = folder.path();
    settings.min_free_mb = 0.0;
    settings.max_file_mb = kill % 2 == 0 ? 0.02 : 256.0;  // every other log changes segments often
    const std::uint64_t fed = readings_until_killed(settings, 30 + random() % kLongestLife);

    const azimuth::Run run = test::load(test::sessions(folder.path()).back());
    segments += session_segments(test::sessions(folder.path()).back()).size();
    cut_events += run.skipped.damaged_bytes > 0 ? 1 : 0;
    for (std::size_t i = 0; i < run.odometry.size(); ++i) ASSERT_EQ(run.odometry[i], test::reading(i));
    // The child may have been fed one reading more than it counted.
    ASSERT_LE(run.odometry.size(), fed + 1);
    ASSERT_GT((run.odometry.size() * test::kReadingInterval) + 1s, fed * test::kReadingInterval);
    ASSERT_EQ(run.rig_toml, test::documents()[0].text);
  }
  EXPECT_GT(segments, 2U * kKills) << "too few changes of segments for the test to mean anything";
  RecordProperty("logs_that_ended_in_half_an_event", static_cast<int>(cut_events));
}

}  // namespace
}  // namespace azimuth
