#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "tools/view/event.hpp"

namespace azimuth {

/// Events that wait to be sent to one client. The outbox holds at most one event of each kind with newest_wins(), and
/// kMostLines of the other kinds together. Replaced and dropped events are counted.
///
/// Thread contract: thread-bound.
class Outbox {
 public:
  static constexpr std::size_t kMostLines = 64;

  void push(const ViewEvent& event);
  /// The oldest event. If events were dropped since the last call, a `missed` event comes first.
  std::optional<ViewEvent> pop();

  bool empty() const { return waiting_.empty(); }
  std::size_t size() const { return waiting_.size(); }
  /// Removes all waiting events and resets missed().
  void clear();
  std::uint64_t missed() const { return missed_; }  ///< not yet reported to the client

 private:
  void drop(const std::deque<ViewEvent>::const_iterator& which);

  std::deque<ViewEvent> waiting_;
  std::uint64_t missed_ = 0, missed_ever_ = 0;
};

/// The outboxes of all clients.
///
/// Thread contract: thread-bound. Borrows the outboxes.
class Lookers {
 public:
  void add(Outbox& outbox) { outboxes_.push_back(&outbox); }
  void remove(Outbox& outbox) { std::erase(outboxes_, &outbox); }
  std::size_t size() const { return outboxes_.size(); }

  void push(const ViewEvent& event) {
    for (Outbox* const outbox : outboxes_) outbox->push(event);
  }

 private:
  std::vector<Outbox*> outboxes_;
};

}  // namespace azimuth
