// Two threads race on both kinds of wire: every lost sample is counted, and none is duplicated or torn.

#include "daemon/pipeline/wires.hpp"

#include <atomic>
#include <chrono>
#include <gtest/gtest.h>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include "base/sanitizers.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kSamples = 200'000;

/// A sample with redundant parts, so that torn reads and mixed-up storage show.
struct Sample {
  std::uint64_t number = 0;
  std::vector<std::uint64_t> copies;

  void set(std::uint64_t value) {
    number = value;
    copies.assign(8, value);
  }
  bool whole() const {
    if (copies.size() != 8) return false;
    for (const std::uint64_t copy : copies) {
      if (copy != number) return false;
    }
    return true;
  }
};

/// The samples that a reader received.
struct Account {
  std::uint64_t read = 0, last = 0;
  bool in_order = true, whole = true;

  void take(const Sample& sample) {
    ++read;
    in_order &= sample.number > last;
    whole &= sample.whole();
    last = sample.number;
  }
};

/// Pauses now and then, so that the wire is sometimes full and sometimes empty.
class Pauses {
 public:
  explicit Pauses(unsigned seed) : random_(seed) {}
  void maybe() {
    if (random_() % 4096 == 0) std::this_thread::sleep_for(std::chrono::microseconds(random_() % 200));
  }

 private:
  std::minstd_rand random_;
};

TEST(EveryOne, MadeIsReadPlusRefused) {
  Doorbell bell;
  EveryOne<Sample, 16> wire(bell);
  std::atomic<bool> done{false};
  Account account;
  std::jthread reader([&] {
    Pauses pauses(1);
    Sample sample;
    const auto drain = [&] {
      while (wire.pop(sample)) {
        account.take(sample);
        pauses.maybe();
      }
    };
    while (!done.load(std::memory_order_acquire)) {
      bell.wait(10ms);
      drain();
    }
    drain();
  });
  std::uint64_t refused = 0;
  {
    std::jthread writer([&] {
      Pauses pauses(2);
      Sample sample;
      for (std::uint64_t i = 1; i <= kSamples; ++i) {
        sample.set(i);
        refused += wire.push(sample) ? 0 : 1;
        pauses.maybe();
      }
    });
  }
  done.store(true, std::memory_order_release);
  bell.ring();
  reader.join();
  EXPECT_EQ(wire.refused(), refused);
  EXPECT_EQ(account.read + refused, kSamples);
  EXPECT_GT(account.read, kSamples / 1000) << "hardly a race";
  EXPECT_TRUE(account.in_order);
  EXPECT_TRUE(account.whole);
}

/// Sleeps until the bell rings; false if it did not ring within 4 s, which means that the ring was lost.
bool sleeps_until_rung(Doorbell& bell) {
  const auto start = std::chrono::steady_clock::now();
  bell.wait(5s);
  return std::chrono::steady_clock::now() - start < 4s;
}

TEST(EveryOne, AWriterThatWaitsForRoomLosesNothingAndIsAlwaysWoken) {
  Doorbell reader_bell, writer_bell;
  EveryOne<Sample, 2> wire(reader_bell, &writer_bell);
  std::atomic<bool> woken{true};
  std::jthread writer([&] {
    Sample sample;
    for (std::uint64_t i = 1; i <= kSamples && woken;) {
      if (!wire.has_room()) {
        if (!sleeps_until_rung(writer_bell)) woken = false;
        continue;
      }
      sample.set(i++);
      EXPECT_TRUE(wire.push(sample));
    }
  });
  Account account;
  Sample sample;
  while (account.read < kSamples && woken) {
    if (!sleeps_until_rung(reader_bell)) woken = false;
    while (wire.pop(sample)) account.take(sample);
  }
  writer.join();
  EXPECT_TRUE(woken) << "a ring was lost after " << account.read << " samples";
  EXPECT_EQ(wire.refused(), 0U);
  EXPECT_EQ(account.last, kSamples);
  EXPECT_TRUE(account.in_order);
  EXPECT_TRUE(account.whole);
}

TEST(EveryOne, RefusesWhenFullAndKeepsWhatItHas) {
  Doorbell bell;
  EveryOne<int, 4> wire(bell);
  for (int i = 0; i < 4; ++i) {
    int value = i;
    EXPECT_TRUE(wire.push(value));
  }
  int refused = 9;
  EXPECT_FALSE(wire.has_room());
  EXPECT_FALSE(wire.push(refused));
  EXPECT_EQ(refused, 9);
  EXPECT_EQ(wire.refused(), 1U);
  int read = -1;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(wire.pop(read));
    EXPECT_EQ(read, i);
  }
  EXPECT_FALSE(wire.pop(read));
  EXPECT_TRUE(wire.has_room());
}

TEST(EveryOne, PassesStorageAroundInsteadOfMakingIt) {
  Doorbell bell;
  EveryOne<std::vector<int>, 2> wire(bell);
  std::vector<int> in(100, 1), out(50, 2);
  const int* const in_storage = in.data();
  const int* const out_storage = out.data();
  wire.push(in);
  wire.pop(out);
  EXPECT_EQ(out.data(), in_storage);
  for (int i = 0; i < 2; ++i) wire.push(in);
  EXPECT_EQ(in.data(), out_storage) << "the reader's old storage comes round to the writer";
}

TEST(Newest, PublishedIsTakenPlusReplaced) {
  Doorbell bell;
  Newest<Sample> wire(bell);
  std::atomic<bool> done{false};
  Account account;
  std::jthread reader([&] {
    Pauses pauses(3);
    Sample sample;
    const auto take = [&] {
      if (wire.take(sample)) account.take(sample);
      pauses.maybe();
    };
    while (!done.load(std::memory_order_acquire)) {
      bell.wait(10ms);
      take();
    }
    take();
  });
  {
    std::jthread writer([&] {
      Pauses pauses(4);
      Sample sample;
      for (std::uint64_t i = 1; i <= kSamples; ++i) {
        sample.set(i);
        wire.publish(sample);
        pauses.maybe();
      }
    });
  }
  done.store(true, std::memory_order_release);
  bell.ring();
  reader.join();
  EXPECT_EQ(account.read + wire.replaced(), kSamples);
  EXPECT_EQ(account.last, kSamples) << "the last value always arrives";
  EXPECT_TRUE(account.in_order);
  EXPECT_TRUE(account.whole);
}

TEST(Newest, GivesAReplacedValueBackAtOnce) {
  Doorbell bell;
  Newest<std::shared_ptr<int>> wire(bell);
  auto first = std::make_shared<int>(1);
  const std::weak_ptr<int> watch = first;
  wire.publish(first);
  auto second = std::make_shared<int>(2);
  wire.publish(second);
  EXPECT_EQ(second.use_count(), 1);
  second.reset();
  EXPECT_TRUE(watch.expired());
  std::shared_ptr<int> taken;
  ASSERT_TRUE(wire.take(taken));
  EXPECT_EQ(*taken, 2);
  EXPECT_FALSE(wire.take(taken));
  EXPECT_EQ(wire.replaced(), 1U);
}

#if !defined(NDEBUG) && !defined(AZIMUTH_THREAD_SANITIZER)
TEST(WiresDeathTest, ASecondWriterIsCaught) {
  Doorbell bell;
  EveryOne<int, 4> wire(bell);
  int value = 1;
  wire.push(value);
  EXPECT_DEATH(std::jthread([&] { wire.push(value); }).join(), "one thread at each end");
}
#endif

TEST(Doorbell, ARingBeforeTheWaitEndsIt) {
  Doorbell bell;
  bell.ring();
  bell.ring();
  const auto start = std::chrono::steady_clock::now();
  bell.wait(10s);
  EXPECT_LT(std::chrono::steady_clock::now() - start, 5s);
}

TEST(Doorbell, WaitTakesAllRingsAndThenSleeps) {
  Doorbell bell;
  for (int i = 0; i < 3; ++i) bell.ring();
  bell.wait(10s);
  const auto start = std::chrono::steady_clock::now();
  bell.wait(30ms);
  EXPECT_GE(std::chrono::steady_clock::now() - start, 29ms);
  bell.wait(-1ms);
}

TEST(Doorbell, EndsASleepOfAnotherThread) {
  Doorbell bell;
  std::jthread ringer([&] {
    std::this_thread::sleep_for(20ms);
    bell.ring();
  });
  const auto start = std::chrono::steady_clock::now();
  bell.wait(10s);
  EXPECT_LT(std::chrono::steady_clock::now() - start, 5s);
}

TEST(Doorbell, AlsoWaitsForADescriptor) {
  Doorbell bell, other;
  const auto far_away = std::chrono::steady_clock::now() + 30s;
  std::jthread later([&] {
    std::this_thread::sleep_for(20ms);
    other.ring();
  });
  bell.wait_also(other.descriptor(), POLLIN, 60s);
  EXPECT_LT(std::chrono::steady_clock::now(), far_away);
  bell.ring();
  bell.wait_also(-1, 0, 60s);
  EXPECT_LT(std::chrono::steady_clock::now(), far_away);
}

}  // namespace
}  // namespace azimuth
