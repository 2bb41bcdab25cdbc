#pragma once
// The hot loops of the scale space: most of the time of an image goes into them. They are compiled for two kinds of
// processor and chosen at run time, and give the same bits on both.

#include <cstdint>

namespace azimuth {

/// Floats that are worked on together; rows may be read and written up to a multiple of it.
inline constexpr int kScaleSpaceLanes = 32;

/// One separable Gaussian blur of a whole image. Beyond the image its edge goes on.
struct BlurTask {
  const float* in;
  float* out;         ///< may not be `in`
  float* difference;  ///< out - in, if not null
  int width, height;
  int stride;            ///< of all three, a multiple of kScaleSpaceLanes and at least width
  const float* weights;  ///< of the middle, then outwards: radius + 1
  int radius;
  float* rows;    ///< scratch of (2 * radius + 1) * stride
  float* padded;  ///< scratch of stride + 2 * radius + kScaleSpaceLanes
};

/// Nine rows about a pixel's row: those above, at and below it in the image of the next smaller scale, of its own and
/// of the next larger.
struct Neighbourhood {
  const float* rows[9];
};

struct ScaleSpaceKernels {
  void (*blur)(const BlurTask&);
  /// Writes the columns from `first` to `last` (not included) whose value in the middle row lies beyond +-threshold and
  /// is not exceeded by any of its 26 neighbours; gives their number. Columns first - 1 and last must exist.
  int (*find_extrema)(const Neighbourhood&, int first, int last, float threshold, std::int32_t* columns);
  /// Values of 1/256 grey level to intensities from 0 to 1.
  void (*to_intensity)(const std::uint16_t* values, int count, float* out);
};

/// For any processor.
const ScaleSpaceKernels& portable_scale_space_kernels();
/// For processors with AVX2 only.
const ScaleSpaceKernels& avx2_scale_space_kernels();
/// The fastest for this one.
const ScaleSpaceKernels& scale_space_kernels();
bool has_avx2();

}  // namespace azimuth
