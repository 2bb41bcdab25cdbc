#pragma once
#include <cstddef>
#include <cstdint>

namespace azimuth {

/// Adjacent pixels of one row.
struct PixelRun {
  std::int32_t row = 0;
  std::int32_t first = 0;
  std::int32_t last = 0;  ///< One past the last pixel
};

/// Finds the bright pixels in columns [first, last) of a row: maximal runs of pixels of at least `level` (`level` >=
/// 1), from left to right. Writes at most `room` runs and returns their number; the return value `room` means that
/// there may be more.
///
/// The result is the same on every processor. Thread contract: reentrant. Nothing allocates.
std::size_t bright_runs(const std::uint8_t* pixels, const PixelRun& where, int level, PixelRun* out, std::size_t room);

namespace avx2 {
std::size_t bright_runs(const std::uint8_t* pixels, const PixelRun& where, int level, PixelRun* out, std::size_t room);
}
namespace portable {
std::size_t bright_runs(const std::uint8_t* pixels, const PixelRun& where, int level, PixelRun* out, std::size_t room);
}

}  // namespace azimuth
