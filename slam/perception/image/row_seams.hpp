#pragma once
#include <array>
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

/// The row of an image that looks most like a tear.
struct Seam {
  int row = -1;             ///< The first row of the lower part; -1 if there is none.
  double stands_out = 0.0;  ///< Likeness of this row to a seam, minus that of the next most likely row
};

/// Finds the row at which an image joins two instants, or from which on it was filled because data were missing.
///
/// In an image of one instant, brightness changes from row to row about as much as between the adjacent pairs of rows,
/// since the optics blur the scene. Where two instants meet, brightness changes more, along the whole row, upwards as
/// often as downwards, and at this row only. The step to a row is therefore compared with the steps before and after
/// it, in chunks of a few pixels, and the result with the results of the other rows of the image: noise, block
/// compression and fine patterns raise the results of all rows alike. Every row is tested at a few chunks, and the most
/// suspicious rows at all chunks.
///
/// A filled part has one value or repeats one row, to the last bit, down to the image's lower end.
///
/// Thread contract: thread-bound. Nothing allocates after construction.
class RowSeams {
 public:
  RowSeams() = default;
  RowSeams(const ImageMask& mask, const FrameFormat& format);

  /// `image` must be readable() and have the pixel format and size given to the constructor.
  Seam seam(const ImageView& image);
  /// The first row of the filled part; -1 if there is none.
  int filled_from(const ImageView& image);

 private:
  // The compared row and the rows before and after it; for Bayer formats, also the rows between these.
  static constexpr int kRowsKept = 5;
  struct Suspect {
    int row = -1;
    double likeness = 0.0;  // To a seam
  };
  using Steps = std::array<float, ChunkGrid::kMostChunks>;
  using Ratios = std::array<std::int32_t, ChunkGrid::kMostChunks>;

  Steps& kept(int row) { return steps_[as_size(row % kRowsKept)]; }
  void measure(const ImageView& image, const ChunkGrid& grid, int row);
  double likeness(const ChunkGrid& grid, std::span<const ChunkGrid::Run> runs);
  void look_here_and_there(const ImageView& image);
  void suspect(int row, double likeness);
  Seam look_all_along(const ImageView& image);
  bool goes_both_ways(const ImageView& image, int row) const;

  ChunkGrid coarse_, fine_;
  std::array<Steps, kRowsKept> steps_{};
  std::array<Suspect, 8> suspects_{};
  std::vector<int> last_step_;  // Of each column of chunks: the row of its last step.
};

}  // namespace azimuth
