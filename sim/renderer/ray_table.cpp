#include "sim/renderer/ray_table.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace azimuth {

namespace {

constexpr double kSteepest_rad = kPi / 2 - 1e-3;  // Keeps slopes finite

/* With the elevation e, t = tan e, the horizontal distance d and the height h of a plane above the camera:
 *   upright objects at d: z = d t        dz = d (1 + t^2) de
 *   the plane:            d = h / t      dd = d (1 + t^2) / |t| de      and d da sideways
 */
PixelRay ray_of(const Direction& seen, const Eigen::Matrix2d& jacobian, const CameraSpace& space) {
  const double slope = std::tan(std::clamp(seen.elevation_rad, -kSteepest_rad, kSteepest_rad));
  const double plane_m = slope > 0.0 ? space.ceiling_m - space.camera_m : -space.camera_m;
  const double distance_m = std::min(plane_m / slope, 1e6);  // Rays along the horizon never meet it
  const double wide_rad = jacobian.row(0).norm(), high_rad = jacobian.row(1).norm();
  const double rise = (1.0 + slope * slope) * high_rad;
  const double depth_m = distance_m * rise / std::max(std::abs(slope), 1e-9);
  PixelRay ray;
  ray.ahead = static_cast<float>(std::cos(seen.azimuth_rad));
  ray.left = static_cast<float>(std::sin(seen.azimuth_rad));
  ray.slope = static_cast<float>(slope);
  ray.plane_distance_m = static_cast<float>(distance_m);
  ray.plane_depth_m = static_cast<float>(std::min(depth_m, 1e3));
  ray.rise_per_m = static_cast<float>(rise);
  ray.width_per_m = static_cast<float>(wide_rad);
  return ray;
}

}  // namespace

RayTable::RayTable(const CameraModel& camera, const ImageMask& mask, int width_px, int height_px,
                   const CameraSpace& space) {
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      const Pixel pixel{u, v};
      const std::optional<Direction> seen = camera.direction(pixel);
      if (!seen || !mask.visible(pixel)) continue;
      PixelRay ray = ray_of(*seen, *camera.direction_jacobian(pixel), space);
      ray.pixel = static_cast<std::uint32_t>(v * width_px + u);
      widest_pixel_rad_ = std::max(widest_pixel_rad_, static_cast<double>(ray.width_per_m));
      rays_.push_back(ray);
    }
  }
  index_by_azimuth();
}

void RayTable::index_by_azimuth() {
  const auto bin_of = [](const PixelRay& ray) {
    const auto bin = static_cast<int>(std::floor(std::atan2(ray.left, ray.ahead) * kBinsPerRad));
    return static_cast<std::size_t>(((bin % kBins) + kBins) % kBins);
  };
  std::vector<std::size_t> bins;
  bins.reserve(rays_.size());
  std::ranges::transform(rays_, std::back_inserter(bins), bin_of);
  bin_starts_.assign(kBins + 1, 0);
  for (const std::size_t bin : bins) ++bin_starts_[bin + 1];
  std::partial_sum(bin_starts_.begin(), bin_starts_.end(), bin_starts_.begin());
  std::vector<std::uint32_t> next(bin_starts_.begin(), bin_starts_.end() - 1);
  by_azimuth_.resize(rays_.size());
  for (std::uint32_t i = 0; i < rays_.size(); ++i) by_azimuth_[next[bins[i]]++] = i;
}

}  // namespace azimuth
