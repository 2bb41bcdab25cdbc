#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace azimuth {

/// Knows rows of an image again that belong to one of those before it: what a camera's buffer still held when only a
/// part of it was written anew.
///
/// A sensor's noise makes every row differ from what it was before. So rows that are equal to the last bit, all those
/// below some row or all those above it, while all others are not, are the other image's. Rows without noise say
/// nothing, nor do those that several older images have: both are painted. Most rows must say something.
///
/// Thread contract: thread-bound. Nothing allocates after construction.
class RowHistory {
 public:
  /// What a row showed; kNothing: no noise.
  using Digest = std::uint64_t;
  static constexpr Digest kNothing = 0;

  RowHistory() = default;
  explicit RowHistory(std::size_t rows);

  std::vector<Digest>& newest() { return images_[newest_]; }  ///< to be filled, from top to bottom

  /// Whether the newest image has rows of an older one. It is remembered then.
  bool add();

 private:
  static constexpr std::size_t kImages = 8;  // cameras have four buffers or so
  using Rows = std::vector<Digest>;

  bool has_rows_of(std::size_t before) const;
  bool is_of_one_instant(std::size_t before, std::size_t row) const;
  const Rows& image(std::size_t before) const { return images_[(newest_ + kImages - before) % kImages]; }

  std::array<Rows, kImages> images_;
  std::size_t newest_ = 0, held_ = 0;
};

}  // namespace azimuth
