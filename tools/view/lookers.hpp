#pragma once
#include <algorithm>
#include <vector>

#include "tools/view/outbox.hpp"

namespace azimuth {

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
