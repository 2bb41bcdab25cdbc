#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "tools/view/event.hpp"

namespace azimuth {

/// What waits to be sent to one who looks. However slow that is, it holds one event of each kind of which the newest
/// wins, and kMostLines of the others; what gave way is counted.
///
/// Thread contract: thread-bound.
class Outbox {
 public:
  static constexpr std::size_t kMostLines = 64;

  void push(const ViewEvent& event);
  /// The oldest; what was missed since the last one is told first.
  std::optional<ViewEvent> pop();

  bool empty() const { return waiting_.empty(); }
  std::size_t size() const { return waiting_.size(); }
  /// Nothing waits, and nothing was missed.
  void clear();
  std::uint64_t missed() const { return missed_; }  ///< not told yet

 private:
  void drop(const std::deque<ViewEvent>::const_iterator& which);

  std::deque<ViewEvent> waiting_;
  std::uint64_t missed_ = 0, missed_ever_ = 0;
};

}  // namespace azimuth
