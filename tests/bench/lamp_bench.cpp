// Lamps in a rendered hall of 1024 x 768: the spot finder (threshold, runs, blobs, centroids), the whole front end up
// to bearings with covariance, and OpenCV's threshold and connected components, which give unweighted centroids.

#include <benchmark/benchmark.h>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "sim/renderer/renderer.hpp"
#include "slam/perception/lamps/lamp_perception.hpp"

namespace azimuth {
namespace {

constexpr int kWidth_px = 1024, kHeight_px = 768;
constexpr double kThreshold = 128.0;

CameraRig rig() {
  CameraRig rig;
  rig.model = EquidistantRig{.focal_length_px = 237.85};
  rig.image.width_px = kWidth_px;
  rig.image.height_px = kHeight_px;
  rig.image.centre_px = {512.0, 384.0};
  rig.image.azimuth_offset_rad = -kPi / 2;
  rig.image.theta_max_rad = 1.57;
  return rig;
}

const std::vector<std::byte>& hall_image() {
  static const std::vector<std::byte> image = [] {
    const RenderCamera camera{
        .model = CameraModel({{512.0, 384.0}, 1.0, -1, -kPi / 2}, EquidistantFisheye{237.85, 1.57}),
        .mask = {},
        .height_m = 1.8,
        .T_body_camera = {},
        .sensor = {1.5, 0.3, 376.0, 1}};
    std::vector<std::byte> bytes(static_cast<std::size_t>(kWidth_px) * kHeight_px);
    Renderer renderer(lamp_scene(hall(1, 1), 6.5), camera);
    renderer.render({4.0, 2.5, 0.3}, {packed_format(PixelFormat::gray8, kWidth_px, kHeight_px), bytes});
    return bytes;
  }();
  return image;
}

ImageView view() { return {packed_format(PixelFormat::gray8, kWidth_px, kHeight_px), hall_image()}; }

void lamp_spots(benchmark::State& state) {
  LampFinder finder({});
  const VisibleRows visible(std::vector<std::uint8_t>(hall_image().size(), 255), kWidth_px, kHeight_px);
  const GrayView image{view().row(0), kWidth_px, kWidth_px, kHeight_px};
  std::vector<LampBlob> spots;
  for (auto _ : state) {
    finder.find(image, visible, spots);
    benchmark::DoNotOptimize(spots.data());
  }
  state.SetLabel(std::to_string(spots.size()) + " spots");
}
BENCHMARK(lamp_spots)->Unit(benchmark::kMicrosecond);

void lamp_bearings(benchmark::State& state) {
  LampPerception perception(rig(), {});
  BearingSet seen;
  for (auto _ : state) {
    perception.observe(view(), seen);
    benchmark::DoNotOptimize(seen.bearings.data());
  }
  state.SetLabel(std::to_string(seen.bearings.size()) + " bearings");
}
BENCHMARK(lamp_bearings)->Unit(benchmark::kMicrosecond);

void opencv_components(benchmark::State& state) {
  cv::setNumThreads(1);
  const std::vector<std::byte>& bytes = hall_image();
  const cv::Mat image(kHeight_px, kWidth_px, CV_8U, const_cast<std::byte*>(bytes.data()));
  cv::Mat bright, labels, numbers, centroids;
  int count = 0;
  for (auto _ : state) {
    cv::threshold(image, bright, kThreshold, 255.0, cv::THRESH_BINARY);
    count = cv::connectedComponentsWithStats(bright, labels, numbers, centroids);
    benchmark::DoNotOptimize(centroids.data);
  }
  state.SetLabel(std::to_string(count - 1) + " components");
}
BENCHMARK(opencv_components)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace azimuth
