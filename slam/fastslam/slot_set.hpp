#pragma once
// A set of slots of a particle's map: one bit for each, in words stored outside this class.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace azimuth {

/// Thread contract: that of the words.
template <class Word = std::uint64_t>
class SlotSet {
 public:
  static constexpr std::size_t kSlotsOfWord = 64;
  static constexpr std::size_t words_for(std::size_t slots) { return (slots + kSlotsOfWord - 1) / kSlotsOfWord; }

  explicit SlotSet(std::span<Word> words) : words_(words) {}

  bool contains(std::size_t slot) const { return (words_[slot / kSlotsOfWord] & bit(slot)) != 0; }
  void insert(std::size_t slot) { words_[slot / kSlotsOfWord] |= bit(slot); }
  void erase(std::size_t slot) { words_[slot / kSlotsOfWord] &= ~bit(slot); }

  /// Calls `what(slot)` for each slot, from the last to the first. `what` may erase this slot and change later ones.
  template <class What>
  void for_each_from_last(What&& what) const {
    for (std::size_t w = words_.size(); w-- > 0;)
      for (std::uint64_t left = words_[w]; left != 0;) {
        const auto highest = kSlotsOfWord - 1 - static_cast<std::size_t>(std::countl_zero(left));
        left &= ~bit(highest);
        what(w * kSlotsOfWord + highest);
      }
  }

 private:
  static std::uint64_t bit(std::size_t slot) { return std::uint64_t{1} << (slot % kSlotsOfWord); }

  std::span<Word> words_;
};

}  // namespace azimuth
