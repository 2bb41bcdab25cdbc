#pragma once
#include <array>
#include <cstddef>
#include <utility>

namespace azimuth {

/// A queue of fixed capacity; if it is full, a new element replaces the oldest.
///
/// Thread contract: thread-bound. Allocates only what its elements allocate.
template <class Element, std::size_t Capacity>
class Ring {
 public:
  /// Returns false if the oldest element was dropped.
  bool push(Element element) {
    const bool room = count_ < Capacity;
    if (!room) {
      first_ = (first_ + 1) % Capacity;
      --count_;
    }
    elements_[(first_ + count_++) % Capacity] = std::move(element);
    return room;
  }
  /// Removes the oldest element. Returns false and leaves `into` unchanged if the queue is empty.
  bool pop(Element& into) {
    if (count_ == 0) return false;
    into = std::move(elements_[first_]);
    first_ = (first_ + 1) % Capacity;
    --count_;
    return true;
  }

 private:
  std::array<Element, Capacity> elements_{};
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace azimuth
