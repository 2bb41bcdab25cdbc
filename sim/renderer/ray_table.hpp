#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "slam/camera/camera_model.hpp"
#include "slam/camera/image_mask.hpp"

namespace azimuth {

/// Rendering uses single precision.
constexpr float to_float(double value) { return static_cast<float>(value); }

/// The ray of one pixel, as far as it does not depend on the robot's pose. Kept small, since each frame reads the rays
/// of all pixels.
struct PixelRay {
  float ahead = 1.0F, left = 0.0F;  ///< Horizontal unit direction from the camera
  float slope = 0.0F;               ///< Rise over horizontal distance
  float plane_distance_m = 0.0F;    ///< Horizontal distance at which the ray meets floor or ceiling
  float plane_depth_m = 0.0F;       ///< Extent of the pixel's area on that plane, away from the camera
  float rise_per_m = 0.0F;          ///< Height of the pixel's area on an upright object, per metre of distance
  float width_per_m = 0.0F;         ///< Width of that area, per metre of distance
  std::uint32_t pixel = 0;          ///< Index of the pixel, row by row
};

/// Heights of the planes that rays can meet.
struct CameraSpace {
  double camera_m = 1.0;   ///< Height of the viewpoint above the floor
  double ceiling_m = 3.0;  ///< Height of the ceiling above the floor
};

/// The rays of all pixels that the mask leaves visible, row by row, with an index by azimuth.
///
/// Thread contract: reentrant.
class RayTable {
 public:
  RayTable(const CameraModel& camera, const ImageMask& mask, int width_px, int height_px, const CameraSpace& space);

  std::span<const PixelRay> rays() const { return rays_; }

  /// Calls use(ray) for each ray whose azimuth is within `half_width_rad` of `azimuth_rad`, and for some others.
  template <class Use>
  void near_azimuth(double azimuth_rad, double half_width_rad, const Use& use) const {
    if (half_width_rad >= kPi) half_width_rad = kPi;
    const auto first = static_cast<int>(std::floor((azimuth_rad - half_width_rad) * kBinsPerRad));
    const auto last = static_cast<int>(std::floor((azimuth_rad + half_width_rad) * kBinsPerRad));
    for (int bin = first; bin <= std::min(last, first + kBins - 1); ++bin) {
      const auto i = static_cast<std::size_t>(((bin % kBins) + kBins) % kBins);
      for (std::uint32_t at = bin_starts_[i]; at < bin_starts_[i + 1]; ++at) use(rays_[by_azimuth_[at]]);
    }
  }

  /// The greatest angle that one pixel covers.
  double widest_pixel_rad() const { return widest_pixel_rad_; }

 private:
  static constexpr int kBins = 1024;
  static constexpr double kBinsPerRad = kBins / (2.0 * kPi);

  void index_by_azimuth();

  std::vector<PixelRay> rays_;
  std::vector<std::uint32_t> bin_starts_, by_azimuth_;
  double widest_pixel_rad_ = 0.0;
};

}  // namespace azimuth
