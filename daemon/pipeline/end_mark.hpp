#pragma once
#include <atomic>

#include "daemon/pipeline/doorbell.hpp"

namespace azimuth {

/// Tells one thread that another thread will send no more data. Once the reader has seen the mark, everything that the
/// writer put into its wires before set() is visible to the reader.
///
/// Thread contract: any thread may call set() and is_set().
class EndMark {
 public:
  /// The first set() rings `reader`.
  explicit EndMark(Doorbell& reader) : reader_(reader) {}

  void set() noexcept {
    if (!is_set_.exchange(true)) reader_.ring();
  }
  bool is_set() const noexcept { return is_set_.load(std::memory_order_acquire); }

 private:
  Doorbell& reader_;
  std::atomic<bool> is_set_{false};
};

}  // namespace azimuth
