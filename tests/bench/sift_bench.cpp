// Azimuth's SIFT and OpenCV's on the same frames: time per image, share of features matched correctly one, two, three
// and six frames later (repeat_N) and share of wrong matches (wrong_N), with a ratio test of 0.7.
//
// OpenCV receives the square that Azimuth's front end has already cut out and filled, in 8-bit grey, with the same
// mask, one thread and the same number of features. Azimuth's time includes all of this: from the camera's image to
// bearings.

#include <benchmark/benchmark.h>
#include <opencv2/core/utility.hpp>
#include <opencv2/features2d.hpp>

#include "slam/camera/make_camera.hpp"
#include "slam/perception/sift/sift_perception.hpp"
#include "tests/bench/sift_frames.hpp"
#include "tests/support/opencv_square.hpp"

namespace azimuth {
namespace {

constexpr double kRatio = 0.7;

CameraModel model_of(const CameraRig& rig) {
  std::string problem;
  return *camera_of(rig, problem);
}

void report(benchmark::State& state, const std::vector<SeenRays>& seen) {
  const PosedDrive& drive = bench_drive();
  for (const std::size_t later : {1U, 2U, 3U, 6U}) {
    const Repeated repeated = find_again(drive, seen, later, kRatio);
    state.counters["repeat_" + std::to_string(later)] = repeated.share;
    state.counters["wrong_" + std::to_string(later)] = repeated.wrong_share;
    state.counters["features"] = repeated.features;
  }
  state.SetLabel(drive.name);
}

SeenRays rays_of(const BearingSet& set) {
  SeenRays seen{set.descriptors, {}};
  for (const Bearing& bearing : set.bearings) seen.rays.push_back(ray({bearing.azimuth_rad, bearing.elevation_rad}));
  return seen;
}

void time_ours(benchmark::State& state, const SiftSettings& settings) {
  const PosedDrive& drive = bench_drive();
  SiftPerception perception(drive.rig, settings);
  BearingSet set;
  std::vector<SeenRays> seen;
  for (const PosedFrame& frame : drive.frames) {
    perception.observe(frame.view(), set);
    seen.push_back(rays_of(set));
  }
  std::size_t next = 0;
  for (auto _ : state) {
    perception.observe(drive.frames[next++ % drive.frames.size()].view(), set);
    benchmark::DoNotOptimize(set.bearings.data());
  }
  report(state, seen);
}

void azimuth_sift(benchmark::State& state) { time_ours(state, {}); }
BENCHMARK(azimuth_sift)->Unit(benchmark::kMillisecond);

/// The paper's scale space and frames, with Azimuth's number of features.
void azimuth_sift_as_printed(benchmark::State& state) {
  SiftSettings settings = paper_sift_preset();
  settings.contrast = SiftSettings{}.contrast;
  settings.target_count = SiftSettings{}.target_count;
  time_ours(state, settings);
}
BENCHMARK(azimuth_sift_as_printed)->Unit(benchmark::kMillisecond);

SeenRays seen_by_opencv(cv::SIFT& sift, const test::OpenCvSquare& square, const WorkingSquare& where,
                        const CameraModel& model) {
  std::vector<cv::KeyPoint> points;
  cv::Mat described;
  sift.detectAndCompute(square.image, square.mask, points, described);
  SeenRays seen;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto direction = model.ray(where.camera_pixel(points[i].pt.x, points[i].pt.y));
    if (!direction) continue;
    seen.rays.push_back(*direction);
    Descriptor& looks = seen.looks.emplace_back();
    for (int j = 0; j < 128; ++j)
      looks.values[static_cast<std::size_t>(j)] =
          static_cast<std::uint8_t>(described.at<float>(static_cast<int>(i), j));
  }
  return seen;
}

void opencv_sift(benchmark::State& state) {
  const PosedDrive& drive = bench_drive();
  cv::setNumThreads(1);
  const CameraModel model = model_of(drive.rig);
  SiftPerception perception(drive.rig, {});
  const cv::Ptr<cv::SIFT> sift = cv::SIFT::create(SiftSettings{}.target_count);
  std::vector<test::OpenCvSquare> squares;
  std::vector<SeenRays> seen;
  for (const PosedFrame& frame : drive.frames) {
    squares.push_back(test::opencv_square(perception, bench_drive().rig, frame.view()));
    seen.push_back(seen_by_opencv(*sift, squares.back(), perception.working_square(), model));
  }
  std::size_t next = 0;
  std::vector<cv::KeyPoint> points;
  cv::Mat described;
  for (auto _ : state) {
    const test::OpenCvSquare& square = squares[next++ % squares.size()];
    sift->detectAndCompute(square.image, square.mask, points, described);
    benchmark::DoNotOptimize(described.data);
  }
  report(state, seen);
}
BENCHMARK(opencv_sift)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace azimuth
