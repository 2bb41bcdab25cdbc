#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/geometry/index.hpp"
#include "slam/perception/image/chunk_grid.hpp"

namespace azimuth {

/// The row of an image that looks most like torn.
struct Seam {
  int row = -1;             ///< the first of the lower part; -1: there is none
  double stands_out = 0.0;  ///< by how much it is more of a seam than any other row is
};

/// Looks for the row at which an image was put together from two instants, or from which on it was filled up for want
/// of more.
///
/// From row to row of a scene brightness changes about as much as it did from the row before and will to the row after:
/// optics blur what they show. Where two instants meet it changes more, along the whole row, upwards as often as
/// downwards, and at this row alone. So the step to a row is compared with those before and after it, in chunks of a
/// few pixels, and what comes of that with other rows of the same image: noise, compression in blocks and fine patterns
/// raise them all alike. Every row is looked at here and there, the most suspicious ones all along.
///
/// A part that was filled up has one value or repeats one row, to the last bit and to the image's lower end.
///
/// Thread contract: thread-bound. Nothing allocates after construction.
class RowSeams {
 public:
  RowSeams() = default;
  RowSeams(const ImageMask& mask, const FrameFormat& format);

  /// `image` must be readable() and of the pixels and size given to the constructor.
  Seam seam(const ImageView& image);
  /// The first row of what was filled up; -1: nothing was.
  int filled_from(const ImageView& image);

 private:
  static constexpr int kRowsKept = 5;  // a step, those before and after it, and for Bayer those between
  struct Suspect {
    int row = -1;
    double likeness = 0.0;  // to a seam
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
  std::vector<int> last_step_;  // the row of each column of chunks
};

}  // namespace azimuth
