#pragma once
#include <atomic>

#include "daemon/pipeline/doorbell.hpp"

namespace azimuth {

/// Says once, from one thread to the next, that nothing more will come. What the one thread put into its wires before
/// is there for the other, once it has seen the mark.
///
/// Thread contract: any thread may set and ask.
class EndMark {
 public:
  /// `reader` is rung when it is set for the first time.
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
