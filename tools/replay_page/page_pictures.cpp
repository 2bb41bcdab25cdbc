#include "tools/replay_page/page_pictures.hpp"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "slam/camera/camera_rig.hpp"
#include "slam/estimator/estimate.hpp"

namespace azimuth {
namespace {

constexpr int kPageQuality = 75;
constexpr int kLargest_px = 800, kSmallest_px = 160;  // limits of the longer side
constexpr double kSmaller = 0.75;

std::size_t stride(std::size_t images, std::size_t spread) {
  return spread == 0 ? 0 : std::max<std::size_t>(1, (images + spread - 1) / spread);
}

/// A view of the matrix for the encoder, which only reads.
ImageView view_of(const cv::Mat& rgb) {
  const auto* bytes = reinterpret_cast<const std::byte*>(rgb.data);
  return {.format = packed_format(PixelFormat::rgb8, rgb.cols, rgb.rows),
          .bytes = {bytes, rgb.total() * rgb.elemSize()}};
}

}  // namespace

PagePictures::PagePictures(const Run& run, const CameraRig& rig, const PictureLimits& limits)
    : run_(run),
      limits_(limits),
      spread_((2 * limits.pictures + 2) / 3),
      every_(stride(run.frames.size(), spread_)),
      images_(run),
      picture_(rig) {}

void PagePictures::before_update(const BearingSet& set, const Estimator& estimator) {
  image_.reset();
  const auto frame = std::ranges::lower_bound(run_.frames, set.stamp, {}, &FrameFile::stamp);
  if (frame == run_.frames.end() || frame->stamp != set.stamp) return;
  image_ = static_cast<std::size_t>(frame - run_.frames.begin());
  seen_ = set;
  estimator.expect(expected_);
}

void PagePictures::after_step(const Estimate& estimate) {
  const bool changed = estimate.health != std::exchange(health_, estimate.health);
  const auto image = std::exchange(image_, std::nullopt);
  if (!image || limits_.pictures == 0) return;
  ids_of(estimate.landmarks, in_map_);
  if (changed && of_changes_ < limits_.pictures - spread_) {
    ++of_changes_;
    const std::string why(to_string(estimate.health));
    take(*image, estimate.reason.empty() ? why : why + ": " + std::string(estimate.reason));
  } else if (*image % every_ == 0) {
    take(*image, {});
  }
}

void PagePictures::take(std::size_t index, std::string why) {
  std::vector<std::byte> jpeg = drawn(index);
  if (!jpeg.empty()) pictures_.push_back({run_.frames[index].stamp, std::move(why), std::move(jpeg)});
}

/// The picture in the largest size that fits its share of the bytes; empty if no size fits.
std::vector<std::byte> PagePictures::drawn(std::size_t index) {
  const ImageView large = picture_.draw(images_.pixels(index, PixelFormat::rgb8), seen_, expected_, in_map_);
  const FrameFormat& format = large.format;
  const cv::Mat whole(format.height_px, format.width_px, CV_8UC3, const_cast<std::byte*>(large.bytes.data()),
                      static_cast<std::size_t>(format.stride_bytes));
  const double longer_px = std::max(whole.cols, whole.rows);
  cv::Mat smaller;
  for (double side_px = std::min<double>(kLargest_px, longer_px); side_px >= kSmallest_px; side_px *= kSmaller) {
    const double scale = side_px / longer_px;
    cv::resize(whole, smaller, {}, scale, scale, cv::INTER_AREA);
    const std::span<const std::byte> jpeg = encoder_.encode(view_of(smaller), kPageQuality);
    if (jpeg.size() <= limits_.bytes / limits_.pictures) return {jpeg.begin(), jpeg.end()};
  }
  return {};
}

}  // namespace azimuth
