#pragma once
// The hot loops of the scale space, which take most of the time of an image. They are compiled for two kinds of
// processor, selected at run time, and give the same bits on both.

#include <cstdint>

namespace azimuth {

/// Number of floats processed together; rows may be read and written up to a multiple of it.
inline constexpr int kScaleSpaceLanes = 32;

/// One separable Gaussian blur of a whole image. Beyond the image, its edge pixels are repeated.
struct BlurTask {
  const float* in;
  float* out;         ///< Must differ from `in`
  float* difference;  ///< Receives out - in, if not null
  int width, height;
  int stride;            ///< Of all three images: a multiple of kScaleSpaceLanes and at least `width`.
  const float* weights;  ///< Radius + 1 weights: of the centre, then outwards.
  int radius;
  float* rows;    ///< Scratch of (2 * radius + 1) * stride floats
  float* padded;  ///< Scratch of stride + 2 * radius + kScaleSpaceLanes floats
};

/// Nine rows about a pixel: the rows above, at and below the pixel in the difference image of the next smaller scale,
/// of its own scale and of the next larger scale.
struct Neighbourhood {
  const float* rows[9];
};

struct ScaleSpaceKernels {
  void (*blur)(const BlurTask&);
  /// Writes the columns in [first, last) whose value in the middle row is above `threshold` or below -`threshold` and
  /// is not exceeded by any of its 26 neighbours; returns their number. Columns first - 1 and last must exist.
  int (*find_extrema)(const Neighbourhood&, int first, int last, float threshold, std::int32_t* columns);
  /// Converts values in 1/256 of a grey level to intensities from 0 to 1.
  void (*to_intensity)(const std::uint16_t* values, int count, float* out);
};

/// For any processor.
const ScaleSpaceKernels& portable_scale_space_kernels();
/// For processors with AVX2 only.
const ScaleSpaceKernels& avx2_scale_space_kernels();
/// The fastest kernels for the present processor.
const ScaleSpaceKernels& scale_space_kernels();
bool has_avx2();

}  // namespace azimuth
