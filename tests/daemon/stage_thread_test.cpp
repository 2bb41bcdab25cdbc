#include "daemon/pipeline/stage_thread.hpp"

#include <atomic>
#include <gtest/gtest.h>
#include <pthread.h>
#include <string>

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr StageSpec kSpec{"stage", 0, -1, 100ms};

TEST(StageThread, TakesTurnsThenALastOne) {
  Doorbell bell;
  std::atomic<int> turns{0};
  StageThread stage(kSpec, bell, [&] {
    bell.wait(10s);
    ++turns;
  });
  stage.start();
  for (int i = 1; i <= 5; ++i) {
    bell.ring();
    while (turns < i) std::this_thread::yield();
  }
  const int before = turns;
  stage.stop();
  EXPECT_GT(turns, before) << "what came before the stop is drained";
}

TEST(StageThread, DrainsWhateverWasPushedBeforeTheStop) {
  for (int round = 0; round < 200; ++round) {
    Doorbell bell;
    std::atomic<int> made{0};
    int seen = 0;
    StageThread stage(kSpec, bell, [&] {
      bell.wait(10s);
      seen = made.load();
    });
    stage.start();
    for (int i = 0; i < round % 7; ++i) {
      made.fetch_add(1);
      bell.ring();
    }
    stage.stop();
    EXPECT_EQ(seen, made.load());
  }
}

TEST(StageThread, StopsAtOnceThoughAsleepAndMayBeStoppedTwiceOrNeverStarted) {
  Doorbell bell;
  StageThread stage(kSpec, bell, [&] { bell.wait(10s); });
  StageThread idle(kSpec, bell, [] {});
  stage.start();
  std::this_thread::sleep_for(5ms);
  const auto start = Clock::now();
  stage.stop();
  EXPECT_LT(Clock::now() - start, 1s);
  stage.stop();
}

TEST(StageThread, IsLateOnlyWhileATurnHangs) {
  Doorbell bell;
  std::atomic<bool> hang{false};
  StageThread stage(kSpec, bell, [&] {
    bell.wait(10ms);
    while (hang) std::this_thread::sleep_for(1ms);
  });
  EXPECT_FALSE(stage.late(Clock::now() + 1h)) << "not running";
  stage.start();
  std::this_thread::sleep_for(50ms);
  EXPECT_FALSE(stage.late(Clock::now()));
  hang = true;
  bell.ring();
  std::this_thread::sleep_for(250ms);
  EXPECT_TRUE(stage.late(Clock::now()));
  hang = false;
  const auto limit = Clock::now() + 5s;
  while (stage.late(Clock::now()) && Clock::now() < limit) std::this_thread::sleep_for(1ms);
  EXPECT_FALSE(stage.late(Clock::now()));
  stage.stop();
  EXPECT_FALSE(stage.late(Clock::now() + 1h));
}

TEST(StageThread, CarriesItsNameAndReportsARefusedCpu) {
  Doorbell bell;
  std::atomic<bool> named{false};
  StageThread stage({"a-stage", 0, 1023, 100ms}, bell, [&] {
    char name[16] = {};
    pthread_getname_np(pthread_self(), name, sizeof name);
    named = std::string(name) == "a-stage";
    bell.wait(10s);
  });
  stage.start();
  stage.stop();
  EXPECT_TRUE(named);
  EXPECT_EQ(stage.cpu_refused(), EINVAL) << "there are not 1024 CPUs";
  EXPECT_EQ(stage.priority_refused(), 0);
}

}  // namespace
}  // namespace azimuth
