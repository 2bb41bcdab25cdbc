// Work on a helper thread beside the estimator's thread. The test also runs under ThreadSanitizer.

#include "daemon/pipeline/helper_threads.hpp"

#include <gtest/gtest.h>
#include <numeric>
#include <thread>
#include <vector>

namespace azimuth {
namespace {

TEST(TaskThread, DoesTheWorkOnAnotherThread) {
  TaskThread runner;
  std::thread::id where;
  runner.begin([&] { where = std::this_thread::get_id(); });
  runner.finish();
  EXPECT_NE(where, std::thread::id());
  EXPECT_NE(where, std::this_thread::get_id());
}

TEST(TaskThread, OneTaskAfterTheOther) {
  TaskThread runner;
  std::vector<int> done;  // without a lock: finish() synchronises the two threads
  for (int i = 0; i < 1000; ++i) {
    runner.begin([&done, i] { done.push_back(i); });
    runner.finish();
    ASSERT_EQ(done.back(), i);
  }
}

TEST(TaskThread, FinishesWhatIsUnderWayBeforeItEnds) {
  for (int i = 0; i < 100; ++i) {
    bool done = false;
    {
      TaskThread runner;
      runner.begin([&] { done = true; });
    }
    ASSERT_TRUE(done);
  }
}

TEST(TaskThread, FinishingNothingDoesNothing) {
  TaskThread runner;
  int done = 0;
  runner.finish();
  runner.begin([&] { ++done; });
  runner.finish();
  runner.finish();
  EXPECT_EQ(done, 1);
}

class Threads : public testing::TestWithParam<int> {};

TEST_P(Threads, DoEachTaskOnce) {
  WorkerThreads workers(GetParam());
  for (std::size_t count : {0U, 1U, 2U, 16U, 100U})
    for (int round = 0; round < 50; ++round) {
      std::vector<int> done(count, 0);
      workers.for_each(count, [&](std::size_t i) { ++done[i]; });
      ASSERT_EQ(std::accumulate(done.begin(), done.end(), std::size_t{0}), count);
      for (const int times : done) ASSERT_EQ(times, 1);
    }
}

INSTANTIATE_TEST_SUITE_P(Counts, Threads, testing::Values(1, 2, 4));

}  // namespace
}  // namespace azimuth
