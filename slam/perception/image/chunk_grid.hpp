#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/camera/image_mask.hpp"
#include "slam/geometry/index.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// Chunks of a few pixels side by side in the rows of an image, evenly spread over its width, and how much they change
/// from row to row.
///
/// Thread contract: reentrant. Nothing allocates after construction.
class ChunkGrid {
 public:
  static constexpr int kChunk_px = 16;
  static constexpr int kMostChunks = 64;

  /// Chunks side by side that show the world in a row, in two before it and in the one after.
  struct Run {
    int row, first, end;
  };

  ChunkGrid() = default;
  /// At most `most_chunks` in a row. `visible` is the mask's raster.
  ChunkGrid(std::span<const std::uint8_t> visible, const FrameFormat& format, int most_chunks);

  /// Rows from one to the next of the same colours.
  int apart() const { return apart_; }
  int chunks() const { return chunks_; }
  /// By row.
  std::span<const Run> runs() const { return runs_; }
  std::span<const Run> runs(int row) const;
  /// The last row in which a chunk shows the world; -1: none.
  int lowest(int chunk) const { return lowest_[as_size(chunk)]; }

  /// What a chunk's bytes differ by from those of the same colours in the row before, summed: for chunks `first` on.
  void steps(const ImageView& image, int row, int first, std::span<float> out) const;
  /// The same with its sign: brighter less darker.
  int rise(const ImageView& image, int row, int chunk) const;
  /// What a step of `levels` grey levels in every byte comes to.
  float step_of(int levels) const { return static_cast<float>(levels * kChunk_px * bytes_per_pixel_); }

 private:
  void find_runs(std::span<const std::uint64_t> visible);

  int height_px_ = 0, apart_ = 1, chunks_ = 0, bytes_per_pixel_ = 0, spacing_bytes_ = 0;
  std::vector<Run> runs_;
  std::vector<int> lowest_;
};

}  // namespace azimuth
