#pragma once
// The wires are the only memory that two threads of the pipeline share. The two kinds of wires differ in what happens
// when the reader is slow.
//
// Values are swapped in and out, so the storage inside them (of a vector, for example) circulates between the wire and
// its two ends. Once every piece has grown to the size needed, nothing allocates.

#include <array>
#include <atomic>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <utility>

#include "daemon/pipeline/doorbell.hpp"

namespace azimuth {

/// Alignment that puts variables written by two threads into different cache lines, against false sharing.
inline constexpr std::size_t kCacheLine = 64;

/// Asserts that only one thread uses one end of a wire. A second thread would lose samples or hang. It costs nothing
/// when assertions are off.
class OneThread {
 public:
  void check() noexcept {
#ifndef NDEBUG
    const std::thread::id self = std::this_thread::get_id();
    std::thread::id expected{};
    const bool first = user_.compare_exchange_strong(expected, self, std::memory_order_relaxed);
    assert((first || expected == self) && "one thread at each end of a wire");
#endif
  }

 private:
#ifndef NDEBUG
  std::atomic<std::thread::id> user_{};
#endif
};

/// A ring that keeps every sample. When the ring is full, a new sample is refused and counted.
///
/// Invariant under all interleavings: samples offered = read + refused + still in the ring.
///
/// Thread contract: one producer (push, has_room), one consumer (pop); any thread may read the counters.
template <class T, std::size_t Capacity>
class EveryOne {
  static_assert(Capacity >= 2 && (Capacity & (Capacity - 1)) == 0, "capacity must be a power of two");

 public:
  /// Every sample rings `consumer`. `producer`, if there is one, rings when a full ring has room again.
  explicit EveryOne(Doorbell& consumer, Doorbell* producer = nullptr) : consumer_(consumer), producer_(producer) {}

  static constexpr std::size_t capacity() { return Capacity; }

  /// Lets `grow` reserve the storage of every slot. Only before the threads start.
  template <class Grow>
  void prepare(const Grow& grow) {
    for (T& slot : slots_) grow(slot);
  }

  /// Moves `value` in and leaves recycled storage of unspecified content in its place. False: refused, `value` is
  /// unchanged.
  bool push(T& value) noexcept {
    writer_.check();
    const std::uint64_t written = write_.load(std::memory_order_relaxed);
    if (written - read_.load(std::memory_order_acquire) == Capacity) {
      refused_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    using std::swap;
    swap(slots_[written % Capacity], value);
    write_.store(written + 1, std::memory_order_release);
    consumer_.ring();
    return true;
  }

  /// Whether the next push() will succeed. After a false result, the producer's doorbell rings once the ring is half
  /// empty. The function is for a producer that can wait.
  bool has_room() noexcept {
    writer_.check();
    if (size() < Capacity) return true;
    // Both sides store before they load, sequentially consistent. So either this thread sees the consumer's newest
    // read, or the consumer sees this flag.
    wants_room_.store(true);
    return size() < Capacity;
  }

  /// Takes the oldest sample and leaves the storage of `into` in the ring. False: the ring is empty, `into` is
  /// unchanged.
  bool pop(T& into) noexcept {
    reader_.check();
    const std::uint64_t read = read_.load(std::memory_order_relaxed);
    const std::uint64_t written = write_.load(std::memory_order_acquire);
    if (written == read) return false;
    using std::swap;
    swap(slots_[read % Capacity], into);
    read_.store(read + 1);
    if (producer_ && written - read - 1 <= Capacity / 2 && wants_room_.load() && wants_room_.exchange(false))
      producer_->ring();
    return true;
  }

  /// Counts a sample that the producer did not even make because there was no room.
  void refuse() noexcept { refused_.fetch_add(1, std::memory_order_relaxed); }

  std::uint64_t refused() const noexcept { return refused_.load(std::memory_order_relaxed); }

  /// Number of samples in the ring, as known at the calling end.
  std::uint64_t size() const noexcept { return write_.load(std::memory_order_relaxed) - read_.load(); }

 private:
  Doorbell& consumer_;
  Doorbell* producer_;
  OneThread writer_, reader_;
  std::array<T, Capacity> slots_{};
  alignas(kCacheLine) std::atomic<std::uint64_t> write_{0};
  alignas(kCacheLine) std::atomic<std::uint64_t> read_{0};
  alignas(kCacheLine) std::atomic<std::uint64_t> refused_{0};
  std::atomic<bool> wants_room_{false};
};

/// Keeps only the newest value, in three slots. An unread value is replaced and counted.
///
/// Invariant under all interleavings: values published = taken + replaced + still in the wire (0 or 1).
///
/// Thread contract: one producer (publish), one consumer (take); any thread may read the counter.
template <class T>
class Newest {
 public:
  explicit Newest(Doorbell& consumer) : consumer_(consumer) {}

  /// Like EveryOne::prepare().
  template <class Grow>
  void prepare(const Grow& grow) {
    for (T& slot : slots_) grow(slot);
  }

  /// Moves `value` in and leaves the value it replaced, or recycled storage of unspecified content, in its place.
  void publish(T& value) noexcept {
    writer_.check();
    using std::swap;
    swap(slots_[back_], value);
    const unsigned before = middle_.exchange(back_ | kFresh, std::memory_order_acq_rel);
    back_ = before & kIndex;
    if (before & kFresh) replaced_.fetch_add(1, std::memory_order_relaxed);
    swap(slots_[back_], value);  // hands a replaced value back at once, so that its resources are released
    consumer_.ring();
  }

  /// Takes the unread value. False: there is none, `into` is unchanged.
  bool take(T& into) noexcept {
    reader_.check();
    if (!(middle_.load(std::memory_order_relaxed) & kFresh)) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    using std::swap;
    swap(slots_[front_], into);
    return true;
  }

  std::uint64_t replaced() const noexcept { return replaced_.load(std::memory_order_relaxed); }

 private:
  static constexpr unsigned kIndex = 3, kFresh = 4;

  Doorbell& consumer_;
  OneThread writer_, reader_;
  std::array<T, 3> slots_{};
  alignas(kCacheLine) unsigned back_ = 0;  // slot of the producer
  alignas(kCacheLine) std::atomic<unsigned> middle_{1};
  alignas(kCacheLine) unsigned front_ = 2;  // slot of the consumer
  alignas(kCacheLine) std::atomic<std::uint64_t> replaced_{0};
};

}  // namespace azimuth
