#pragma once
// The only memory two threads of the pipeline share. Two kinds, named by what happens when the reader is slow.
//
// Values are swapped in and out, so the storage inside them (a vector's, say) goes round between the two ends and the
// wire: once every piece has grown to the size needed, nothing allocates.

#include <array>
#include <atomic>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <utility>

#include "daemon/pipeline/doorbell.hpp"

namespace azimuth {

/// What two threads write is kept apart by this, so that they do not fight over one cache line.
inline constexpr std::size_t kCacheLine = 64;

/// Asserts that one end of a wire is used by one thread only: a second one would lose samples or hang. Costs nothing
/// where assertions are off.
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

/// Every sample counts: a ring. Full: the new sample is refused and counted.
///
/// Made = read + refused + still inside, whatever the threads do.
///
/// Thread contract: one producer (push, has_room), one consumer (pop); counters may be read by any thread.
template <class T, std::size_t Capacity>
class EveryOne {
  static_assert(Capacity >= 2 && (Capacity & (Capacity - 1)) == 0, "capacity must be a power of two");

 public:
  /// `consumer` is rung for every sample; `producer`, if there is one, when a full ring has room again.
  explicit EveryOne(Doorbell& consumer, Doorbell* producer = nullptr) : consumer_(consumer), producer_(producer) {}

  static constexpr std::size_t capacity() { return Capacity; }

  /// Lets `grow` give every slot its storage beforehand. Only before the threads start.
  template <class Grow>
  void prepare(const Grow& grow) {
    for (T& slot : slots_) grow(slot);
  }

  /// Takes `value` in and leaves recycled storage of unspecified content in its place. False: refused, `value`
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

  /// Whether the next push() will succeed. When it says no, the producer's doorbell rings once the ring is half empty:
  /// for a producer that can wait.
  bool has_room() noexcept {
    writer_.check();
    if (size() < Capacity) return true;
    // Either this thread sees what the consumer has read since, or the consumer sees this flag: both sides store
    // before they load, sequentially consistent.
    wants_room_.store(true);
    return size() < Capacity;
  }

  /// Takes the oldest sample out and leaves the storage of `into` in the ring. False: empty, `into` unchanged.
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

  /// Counts a sample that was not even made for want of room.
  void refuse() noexcept { refused_.fetch_add(1, std::memory_order_relaxed); }

  std::uint64_t refused() const noexcept { return refused_.load(std::memory_order_relaxed); }

  /// How many are in it, by what this end of it knows of the other.
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

/// Only the newest counts: three slots. An unread value is replaced and counted.
///
/// Published = taken + replaced + still inside (0 or 1), whatever the threads do.
///
/// Thread contract: one producer (publish), one consumer (take); the counter may be read by any thread.
template <class T>
class Newest {
 public:
  explicit Newest(Doorbell& consumer) : consumer_(consumer) {}

  /// As EveryOne::prepare().
  template <class Grow>
  void prepare(const Grow& grow) {
    for (T& slot : slots_) grow(slot);
  }

  /// Takes `value` in and leaves in its place the value it replaced, or recycled storage of unspecified content.
  void publish(T& value) noexcept {
    writer_.check();
    using std::swap;
    swap(slots_[back_], value);
    const unsigned before = middle_.exchange(back_ | kFresh, std::memory_order_acq_rel);
    back_ = before & kIndex;
    if (before & kFresh) replaced_.fetch_add(1, std::memory_order_relaxed);
    swap(slots_[back_], value);  // a replaced value leaves now, and whatever it holds on to with it
    consumer_.ring();
  }

  /// Takes the unread value out. False: nothing new, `into` unchanged.
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
  alignas(kCacheLine) unsigned back_ = 0;  // the producer's
  alignas(kCacheLine) std::atomic<unsigned> middle_{1};
  alignas(kCacheLine) unsigned front_ = 2;  // the consumer's
  alignas(kCacheLine) std::atomic<std::uint64_t> replaced_{0};
};

}  // namespace azimuth
