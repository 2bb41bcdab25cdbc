#include "slam/perception/sift/opencv_sift.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>
#include <span>

namespace azimuth {
namespace {

constexpr float kDegree = 3.14159265F / 180.0F;

KeyPoint ours(const cv::KeyPoint& theirs) {
  return {.x_px = theirs.pt.x,
          .y_px = theirs.pt.y,
          .sigma_px = 0.5F * theirs.size,
          .response = theirs.response,
          .angle_rad = theirs.angle * kDegree,
          .octave = theirs.octave};  // Packed in OpenCV's own format
}

cv::KeyPoint theirs(const KeyPoint& ours) {
  return {ours.x_px, ours.y_px, 2.0F * ours.sigma_px, ours.angle_rad / kDegree, ours.response, ours.octave};
}

class OpenCvSift final : public FeatureFinder {
 public:
  // OpenCV divides the contrast by the number of scales.
  explicit OpenCvSift(const SiftSettings& settings)
      : sift_(cv::SIFT::create(0, settings.scales_per_octave, settings.contrast * settings.scales_per_octave,
                               settings.curvature_ratio, settings.first_sigma_px)),
        clearance_sigmas_(static_cast<float>(settings.clearance_sigmas)) {}

  void detect(const Plane<std::uint16_t>& image, const VisibleRegion& region, std::vector<KeyPoint>& out) override {
    copy(image);
    sift_->detect(image_, found_);
    out.clear();
    for (const cv::KeyPoint& found : found_) {
      const KeyPoint point = ours(found);
      const float clearance_px = region.clearance_px(point.x_px, point.y_px);
      if (clearance_px >= std::max(1.0F, clearance_sigmas_ * point.sigma_px)) out.push_back(point);
    }
  }

  void describe(std::vector<KeyPoint>& key_points, std::vector<Descriptor>& out) override {
    found_.clear();
    for (const KeyPoint& point : key_points) found_.push_back(theirs(point));
    if (!found_.empty()) sift_->compute(image_, found_, described_);
    key_points.clear();
    out.clear();
    for (std::size_t i = 0; i < found_.size(); ++i) {
      key_points.push_back(ours(found_[i]));
      const float* const values = described_.ptr<float>(static_cast<int>(i));
      std::ranges::transform(std::span(values, 128), out.emplace_back().values.begin(),
                             [](float value) { return static_cast<std::uint8_t>(value); });
    }
  }

 private:
  void copy(const Plane<std::uint16_t>& image) {
    image_.create(image.height(), image.width(), CV_8UC1);
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        image_.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>((image.at(x, y) + 128) >> 8);
  }

  cv::Ptr<cv::SIFT> sift_;
  float clearance_sigmas_;
  cv::Mat image_, described_;
  std::vector<cv::KeyPoint> found_;
};

}  // namespace

std::unique_ptr<FeatureFinder> opencv_sift(const SiftSettings& settings) {
  return std::make_unique<OpenCvSift>(settings);
}

}  // namespace azimuth
