// Coloured landmarks in one frame of 1024 x 768: Azimuth's detector, and OpenCV with HSV conversion, one mask per class
// and connected components. OpenCV computes only areas and centroids, no sides and no angles.

#include <benchmark/benchmark.h>
#include <opencv2/imgproc.hpp>

#include "sim/renderer/renderer.hpp"
#include "slam/camera/make_camera.hpp"
#include "slam/perception/colour/colour_perception.hpp"
#include "slam/perception/image/row_seams.hpp"

namespace azimuth {
namespace {

const ImageAxes kAxes{{511.5, 383.5}, 1.0, -1, -kPi / 2};

struct Frame {
  FrameFormat format;
  std::vector<std::byte> bytes;
};

/// The lab through a mirror, with sensor noise.
Frame lab_frame(PixelFormat pixels) {
  const RenderScene scene = coloured_scene(lab(1, 1));
  const RenderCamera camera{.model = CameraModel(kAxes, HyperbolicMirror{28.095, 23.4125, 1035.376}),
                            .mask = {60.0, 376.0, {}},
                            .height_m = 1.0,
                            .T_body_camera = {},
                            .sensor = {1.5, 0.3, 376.0, 1}};
  Frame frame{packed_format(pixels, camera.width_px, camera.height_px), {}};
  frame.bytes.resize(frame.format.bytes());
  Renderer(scene, camera).render({4.0, 2.5, 0.3}, {frame.format, frame.bytes});
  return frame;
}

CameraRig mirror_rig() {
  CameraRig rig{.model = RadialRig{}, .image = {}};
  rig.image.width_px = 1024;
  rig.image.height_px = 768;
  rig.image.centre_px = {511.5, 383.5};
  rig.image.azimuth_offset_rad = -kPi / 2;
  rig.image.mask_inner_px = 60.0;
  rig.image.mask_outer_px = 376.0;
  return rig;
}

void azimuth_colour(benchmark::State& state, PixelFormat pixels) {
  const Frame frame = lab_frame(pixels);
  ColourPerception perception(mirror_rig(), {});
  BearingSet set;
  for (auto _ : state) {
    perception.observe({frame.format, frame.bytes}, set);
    benchmark::DoNotOptimize(set.bearings.data());
  }
  state.counters["found"] = static_cast<double>(set.bearings.size());
}

/// OpenCV halves the hue in degrees. An interval through hue 0 needs two masks.
void mask_of_class(const cv::Mat& hsv, const ColourClass& colours, cv::Mat& mask, cv::Mat& rest) {
  const auto bound = [](double hue_deg, double saturation, double value) {
    return cv::Scalar(hue_deg / 2, saturation * 255, value * 255);
  };
  const cv::Scalar low = bound(colours.hue_from_deg, colours.saturation_min, colours.value_min);
  const cv::Scalar high = bound(colours.hue_to_deg, colours.saturation_max, colours.value_max);
  if (colours.hue_from_deg <= colours.hue_to_deg) return cv::inRange(hsv, low, high, mask);
  cv::inRange(hsv, low, cv::Scalar(180, high[1], high[2]), mask);
  cv::inRange(hsv, cv::Scalar(0, low[1], low[2]), high, rest);
  cv::bitwise_or(mask, rest, mask);
}

void opencv_colour(benchmark::State& state, PixelFormat pixels) {
  cv::setNumThreads(1);
  Frame frame = lab_frame(pixels);
  const bool is_yuv = pixels == PixelFormat::yuyv;
  const cv::Mat image(768, 1024, is_yuv ? CV_8UC2 : CV_8UC3, frame.bytes.data());
  const ColourSettings settings;
  cv::Mat rgb, hsv, mask, rest, labels, statistics, centroids;
  int found = 0;
  for (auto _ : state) {
    found = 0;
    if (is_yuv) cv::cvtColor(image, rgb, cv::COLOR_YUV2RGB_YUYV);
    cv::cvtColor(is_yuv ? rgb : image, hsv, cv::COLOR_RGB2HSV);
    for (const ColourClass& colours : settings.classes) {
      mask_of_class(hsv, colours, mask, rest);
      const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centroids, 8, CV_32S);
      for (int i = 1; i < count; ++i) found += statistics.at<int>(i, cv::CC_STAT_AREA) >= settings.area_min_px2 ? 1 : 0;
    }
    benchmark::DoNotOptimize(found);
  }
  state.counters["found"] = found;
}

/// Time of the check for torn images, which should be a small part of the front end's time.
void torn_check(benchmark::State& state, PixelFormat pixels) {
  const Frame frame = lab_frame(pixels);
  const ImageRig rig = mirror_rig().image;
  const ImageView image{frame.format, frame.bytes};
  RowSeams seams(ImageMask(axes_of(rig), mask_of(rig)), frame.format);
  for (auto _ : state) {
    benchmark::DoNotOptimize(seams.filled_from(image));
    benchmark::DoNotOptimize(seams.seam(image).stands_out);
  }
}

BENCHMARK_CAPTURE(azimuth_colour, rgb8, PixelFormat::rgb8)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(opencv_colour, rgb8, PixelFormat::rgb8)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(torn_check, rgb8, PixelFormat::rgb8)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(azimuth_colour, yuyv, PixelFormat::yuyv)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(opencv_colour, yuyv, PixelFormat::yuyv)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(torn_check, yuyv, PixelFormat::yuyv)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace azimuth
