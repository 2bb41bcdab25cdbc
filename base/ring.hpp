#pragma once
#include <array>
#include <cstddef>
#include <utility>

namespace azimuth {

/// A queue of fixed size; when it is full the oldest element gives way.
///
/// Thread contract: thread-bound. Allocates only what its elements do.
template <class Element, std::size_t Capacity>
class Ring {
 public:
  /// False: an element had to give way.
  bool push(Element element) {
    const bool room = count_ < Capacity;
    if (!room) {
      first_ = (first_ + 1) % Capacity;
      --count_;
    }
    elements_[(first_ + count_++) % Capacity] = std::move(element);
    return room;
  }
  /// Takes the oldest element out. False: empty, `into` unchanged.
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
