#include "slam/perception/sift/own_sift.hpp"

#include <cmath>

namespace azimuth {

OwnSift::OwnSift(const SiftSettings& settings, const ScaleSpaceKernels& kernels)
    : frame_(settings.frame), space_(settings, kernels), finder_(settings), maker_(settings) {}

void OwnSift::detect(const Plane<std::uint16_t>& image, const VisibleRegion& region, std::vector<KeyPoint>& out) {
  centre_px_ = 0.5F * static_cast<float>(image.width() - 1);
  space_.build(image);
  finder_.find(space_, region, out);
}

void OwnSift::describe(std::vector<KeyPoint>& key_points, std::vector<Descriptor>& out) {
  out.clear();
  for (const KeyPoint& point : key_points) out.push_back(maker_.describe(space_, point, axis_of(point)));
}

FrameAxis OwnSift::axis_of(const KeyPoint& point) const {
  if (frame_ == DescriptorFrame::image) return {};
  const float x = point.x_px - centre_px_, y = point.y_px - centre_px_;
  const float radius_px = std::sqrt(x * x + y * y);
  return radius_px > 0.0F ? FrameAxis{x / radius_px, y / radius_px} : FrameAxis{};
}

}  // namespace azimuth
