#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace azimuth {

/// Recognises rows that belong to an earlier image: a camera's buffer still holds them if only a part of it was
/// rewritten.
///
/// Sensor noise makes every row differ from the same row of other images. An image is torn if its rows below some row
/// (or above it) equal those of an earlier image to the last bit while all other rows differ. Rows without noise are
/// ignored, as are rows that several earlier images share: both are synthetic. Most rows must carry noise for a
/// verdict.
///
/// Thread contract: thread-bound. Nothing allocates after construction.
class RowHistory {
 public:
  /// Digest of a row's pixels; kNothing for a row without noise.
  using Digest = std::uint64_t;
  static constexpr Digest kNothing = 0;

  RowHistory() = default;
  explicit RowHistory(std::size_t rows);

  std::vector<Digest>& newest() { return images_[newest_]; }  ///< To be filled from top to bottom

  /// Adds the newest image to the history. Returns whether it has rows of an earlier image.
  bool add();

 private:
  static constexpr std::size_t kImages = 8;  // Cameras typically have about four buffers
  using Rows = std::vector<Digest>;

  bool has_rows_of(std::size_t before) const;
  bool is_of_one_instant(std::size_t before, std::size_t row) const;
  const Rows& image(std::size_t before) const { return images_[(newest_ + kImages - before) % kImages]; }

  std::array<Rows, kImages> images_;
  std::size_t newest_ = 0, held_ = 0;
};

}  // namespace azimuth
