#pragma once
#include <cstddef>
#include <cstdint>

namespace azimuth {

/// Pixels side by side in one row.
struct PixelRun {
  std::int32_t row = 0;
  std::int32_t first = 0;
  std::int32_t last = 0;  ///< the one behind
};

/// Finds what shines in columns [first, last) of a row: maximal runs of pixels of `level` (at least 1) or more, from
/// left to right. Writes at most `room` of them and gives how many; `room` means that there may be more.
///
/// The same on every processor. Thread contract: reentrant. Nothing allocates.
std::size_t bright_runs(const std::uint8_t* pixels, const PixelRun& where, int level, PixelRun* out, std::size_t room);

namespace avx2 {
std::size_t bright_runs(const std::uint8_t* pixels, const PixelRun& where, int level, PixelRun* out, std::size_t room);
}
namespace portable {
std::size_t bright_runs(const std::uint8_t* pixels, const PixelRun& where, int level, PixelRun* out, std::size_t room);
}

}  // namespace azimuth
