#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/camera/image_mask.hpp"
#include "slam/geometry/index.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// Chunks of a few adjacent pixels in the rows of an image, evenly spread over its width, and their changes from row to
/// row.
///
/// Thread contract: reentrant. Nothing allocates after construction.
class ChunkGrid {
 public:
  static constexpr int kChunk_px = 16;
  static constexpr int kMostChunks = 64;

  /// Adjacent chunks that show the world in the row itself, in the two compared rows before it and in the one after it.
  struct Run {
    int row, first, end;
  };

  ChunkGrid() = default;
  /// At most `most_chunks` chunks in a row. `visible` is the raster of the mask.
  ChunkGrid(std::span<const std::uint8_t> visible, const FrameFormat& format, int most_chunks);

  /// Distance from one row to the next row of the same colours: 2 for Bayer formats, else 1.
  int apart() const { return apart_; }
  int chunks() const { return chunks_; }
  /// Sorted by row.
  std::span<const Run> runs() const { return runs_; }
  std::span<const Run> runs(int row) const;
  /// The last row in which a chunk shows the world; -1 if there is none.
  int lowest(int chunk) const { return lowest_[as_size(chunk)]; }

  /// Sums, for each chunk from `first` on, the absolute differences of its bytes from those in the previous row of the
  /// same colours.
  void steps(const ImageView& image, int row, int first, std::span<float> out) const;
  /// The signed sum for one chunk: positive if the row is brighter than the previous one.
  int rise(const ImageView& image, int row, int chunk) const;
  /// The sum that a step of `levels` grey levels in every byte gives.
  float step_of(int levels) const { return static_cast<float>(levels * kChunk_px * bytes_per_pixel_); }

 private:
  void find_runs(std::span<const std::uint64_t> visible);

  int height_px_ = 0, apart_ = 1, chunks_ = 0, bytes_per_pixel_ = 0, spacing_bytes_ = 0;
  std::vector<Run> runs_;
  std::vector<int> lowest_;
};

}  // namespace azimuth
