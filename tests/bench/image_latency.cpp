// Latency from a complete image at the camera to its pose on LCM: the real link between processes, the real front ends
// and the real estimator, with images rendered in advance. Each image comes with its odometry, without delay.

#include <benchmark/benchmark.h>
#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>
#include <vector>

#include "daemon/devices/camera_source.hpp"
#include "daemon/pipeline/pipeline.hpp"
#include "slam/perception/make_perception.hpp"
#include "slam/planar/make_ekf_estimator.hpp"
#include "tests/bench/camera_process.hpp"
#include "tests/bench/latencies.hpp"
#include "tests/bench/quantiles.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using bench::PromptOdometer, bench::Views;

constexpr auto kTime = 12s;

Stages stages(const Rig& rig, std::vector<std::unique_ptr<Source>> sources, bench::Latencies& latencies) {
  Publisher publisher(PublishSettings{});  // the multicast stays on this machine
  publisher.listen([&](std::string_view channel, std::span<const std::byte> message, Stamp utime) {
    latencies.published(channel, message, utime);
  });
  return {.sources = std::move(sources),
          .perception = PerceptionStage(make_perception(rig.front_end, rig.camera, {}), PixelFormat::rgb8),
          .estimator = EstimatorStage(make_ekf_estimator(rig, EkfSettings{}), rig, StageSettings{}),
          .publisher = std::move(publisher)};
}

/// Counts the images lost in each place. Images wait only in the camera's slots; the camera skips images if all slots
/// are taken.
void count_images(benchmark::State& state, const CameraServerCounts& camera, const Pipeline& pipeline,
                  const Status& status) {
  state.counters["images"] = static_cast<double>(camera.frames + camera.frames_skipped);
  state.counters["no_slot"] = static_cast<double>(camera.frames_skipped);
  state.counters["replaced"] = static_cast<double>(pipeline.losses().frames_replaced);
  state.counters["refused"] = static_cast<double>(pipeline.losses().bearings_refused);
  state.counters["mapped"] = static_cast<double>(status.landmarks);
  state.counters["detect_us"] = status.perception.detect_mean_us;
}

void image_to_pose_sent(benchmark::State& state, FrontEnd front_end, PixelFormat pixels) {
  const Rig rig = bench::rig_of(front_end);
  const Views views(rig, pixels);
  const std::filesystem::path socket = bench::camera_socket();
  for (auto _ : state) {
    bench::Latencies latencies;
    std::vector<std::unique_ptr<Source>> sources;
    auto owned = std::make_unique<PromptOdometer>();
    PromptOdometer& odometer = *owned;
    sources.push_back(std::move(owned));
    sources.push_back(std::make_unique<SharedCameraSource>(socket, Duration{0}, 2s));
    Doorbell bell;
    Pipeline pipeline(stages(rig, std::move(sources), latencies), ThreadSettings{}, bell);
    bench::Camera camera(bench::serve(socket, views.format()), views, static_cast<double>(state.range(0)), odometer,
                         latencies);
    pipeline.start();
    {
      const std::jthread process([&](const std::stop_token& stop) { camera.run(stop); });
      std::this_thread::sleep_for(kTime);
    }
    pipeline.stop();
    Status status;
    pipeline.take_status(status);
    count_images(state, camera.counts(), pipeline, status);
    bench::count_quantiles(state, latencies.take());
  }
}
BENCHMARK_CAPTURE(image_to_pose_sent, colour_1024x768_yuyv, FrontEnd::colour, PixelFormat::yuyv)
    ->ArgName("hz")
    ->Arg(15)
    ->Arg(60)
    ->Iterations(1)
    ->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(image_to_pose_sent, colour_1024x768_rgb8, FrontEnd::colour, PixelFormat::rgb8)
    ->ArgName("hz")
    ->Arg(15)
    ->Iterations(1)
    ->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(image_to_pose_sent, sift_480x480_gray8, FrontEnd::sift, PixelFormat::gray8)
    ->ArgName("hz")
    ->Arg(15)
    ->Arg(60)
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

}  // namespace
}  // namespace azimuth
