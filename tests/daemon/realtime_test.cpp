// The status of real-time scheduling: in force, refused, or not requested.

#include "daemon/supervise/realtime.hpp"

#include <gmock/gmock.h>
#include <pthread.h>
#include <sys/resource.h>
#include <thread>
#include <unistd.h>

#include "daemon/publish/messages.hpp"
#include "tests/daemon/child_process.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Optional;

/// A started stage, whose turns are counted.
struct Begun {
  explicit Begun(const StageSpec& spec) : stage(spec, bell, [this] { turn(); }) {
    stage.start();
    EXPECT_TRUE(test::eventually([this] { return turns.load() > 0; }, 10s));
  }
  void turn() {
    bell.wait(10ms);
    ++turns;
  }
  std::atomic<int> turns{0};
  Doorbell bell;
  StageThread stage;
};

TEST(RealTimeReport, IsEmptyWhereNothingWasAskedFor) {
  Begun stage({.name = "plain", .deadline = 1s});
  const RealTime report = real_time({&stage.stage}, false, std::nullopt);
  EXPECT_EQ(report.text, "");
  EXPECT_THAT(report.refusals, IsEmpty());
}

TEST(RealTimeReport, SaysWhatIsInForceAndWhatWasRefused) {
  Begun nowhere({.name = "nowhere", .cpu = 1023, .deadline = 1s});
  EXPECT_EQ(real_time({}, true, std::nullopt).text, "memory locked");
  const RealTime report = real_time({&nowhere.stage}, true, "memory is not locked: too little");
  EXPECT_THAT(report.refusals, ElementsAre(HasSubstr("nowhere: CPU 1023 refused"), "memory is not locked: too little"));
  EXPECT_EQ(report.text, report.refusals[0] + "; " + report.refusals[1]);
  EXPECT_EQ(real_time({&nowhere.stage}, true, std::nullopt).text, "memory locked; " + report.refusals[0]);
}

TEST(RealTimeReport, NamesAPriorityThatIsInForceOrRefused) {
  Begun stage({.name = "urgent", .fifo_priority = 1, .deadline = 1s});
  const RealTime report = real_time({&stage.stage}, false, std::nullopt);
  if (stage.stage.priority_refused() == 0) {
    EXPECT_EQ(report.text, "SCHED_FIFO");
  } else {
    EXPECT_THAT(report.text, HasSubstr("urgent: SCHED_FIFO priority 1 refused: Operation not permitted"));
  }
}

TEST(RealTimeReport, IsInTheStatusMessageAndRefusalsInTheStatusLine) {
  Status status;
  status.process = {.realtime = "SCHED_FIFO, memory locked", .realtime_refused = false, .configuration = ""};
  EXPECT_EQ(status_message(status).realtime, "SCHED_FIFO, memory locked");
  EXPECT_THAT(status_line(status, {}), testing::Not(HasSubstr("realtime")));
  status.process = {.realtime = "no", .realtime_refused = true, .configuration = "line 3"};
  EXPECT_THAT(status_line(status, {}), HasSubstr("realtime: no"));
  EXPECT_THAT(status_line(status, {}), HasSubstr("configuration: line 3"));
  EXPECT_EQ(status_message(status).configuration, "line 3");
}

TEST(ThreadStacks, AreSmallEnoughToBeLocked) {
  limit_thread_stacks();
  std::size_t bytes = 0;
  std::thread([&bytes] {
    pthread_attr_t attributes;
    ASSERT_EQ(pthread_getattr_np(pthread_self(), &attributes), 0);
    EXPECT_EQ(pthread_attr_getstacksize(&attributes, &bytes), 0);
    pthread_attr_destroy(&attributes);
  }).join();
  EXPECT_GE(bytes, std::size_t{1} << 20);
  EXPECT_LT(bytes, std::size_t{2} << 20);
}

TEST(MemoryLock, IsNotTriedUnderAFiniteLimitAndSaysWhatItNeeds) {
  if (geteuid() == 0) GTEST_SKIP() << "root is not limited";
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_MEMLOCK, &before), 0);
  rlimit low = before;
  low.rlim_cur = 64 << 10;
  ASSERT_EQ(setrlimit(RLIMIT_MEMLOCK, &low), 0);
  EXPECT_THAT(lock_memory(), Optional(HasSubstr("LimitMEMLOCK=infinity")));
  setrlimit(RLIMIT_MEMLOCK, &before);
}

}  // namespace
}  // namespace azimuth
