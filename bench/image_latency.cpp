// From the moment a camera hands over a whole image to the moment its pose has been sent over LCM: the real link
// between processes, the real front ends and the real estimator, with images of a simulated camera rendered beforehand.
// Each image comes with the odometry it needs, as if that were never late.

#include <atomic>
#include <benchmark/benchmark.h>
#include <chrono>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include "bench/latencies.hpp"
#include "bench/quantiles.hpp"
#include "daemon/devices/shared_camera_source.hpp"
#include "daemon/pipeline/pipeline.hpp"
#include "drivers/camera/camera_server.hpp"
#include "sim/renderer/rig_camera.hpp"
#include "sim/renderer/standard_cameras.hpp"
#include "slam/estimator/make_estimator.hpp"
#include "slam/perception/make_perception.hpp"

namespace azimuth {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr int kViews = 60;  // along the robot's way, to and fro
constexpr double kStride_m = 0.033;
constexpr auto kTime = 12s;

Pose2 T_start_body(int view) { return {kStride_m * view, 0.0, 0.0}; }

Rig rig_of(FrontEnd front_end) {
  Rig rig;
  rig.front_end = front_end;
  rig.camera = *standard_camera("mirror");
  if (front_end != FrontEnd::sift) return rig;
  ImageRig& image = rig.camera.image;  // the same mirror, whole, in a square
  const double scale = 235.0 / *image.mask_outer_px;
  image.width_px = image.height_px = 480;
  image.centre_px = PixelPoint{239.5, 239.5};
  for (std::optional<double>* length : {&image.focal_length_px, &image.mask_inner_px, &image.mask_outer_px})
    **length *= scale;
  return rig;
}

/// What the camera sees at each place of the way.
class Views {
 public:
  Views(const Rig& rig, PixelFormat pixels) {
    std::string problem;
    std::optional<RenderCamera> camera = render_camera_of(rig.camera, problem);
    if (!camera) throw std::invalid_argument(problem);
    camera->sensor = {.noise = 1.5, .vignetting = 0.25, .vignetting_radius_px = 0.5 * camera->height_px, .seed = 1};
    Renderer renderer(coloured_scene(lab(1, 1)), *camera);
    format_ = packed_format(pixels, camera->width_px, camera->height_px);
    for (int i = 0; i < kViews; ++i) {
      std::vector<std::byte>& image = images_.emplace_back(format_.bytes());
      renderer.render(Pose2{4.0, 2.0, 0.0} * T_start_body(i), {format_, image});
    }
  }
  const FrameFormat& format() const { return format_; }
  const std::vector<std::byte>& at(int view) const { return images_.at(static_cast<std::size_t>(view)); }

 private:
  FrameFormat format_;
  std::vector<std::vector<std::byte>> images_;
};

/// The place of the n-th image on the way to and fro.
int view_of(std::uint64_t image) {
  const int place = static_cast<int>(image % (2 * kViews - 2));
  return place < kViews ? place : 2 * kViews - 2 - place;
}

/// Knows where the robot was at the newest image, and says so at once.
class PromptOdometer final : public Source {
 public:
  const char* name() const override { return "odometer"; }

  void image_taken(Stamp stamp, std::uint64_t number) {
    image_.store(number, std::memory_order_relaxed);
    stamp_us_.store(to_us(stamp), std::memory_order_release);
    if (Doorbell* bell = bell_.load()) bell->ring();
  }
  bool turn(Doorbell& bell, SourceWires& wires) override {
    bell_ = &bell;
    bell.wait(100ms);
    const std::int64_t stamp_us = stamp_us_.load(std::memory_order_acquire);
    if (stamp_us == last_us_) return true;
    last_us_ = stamp_us;
    OdometryReading reading{.stamp = stamp_from_us(stamp_us + 1), .sequence = count_++, .T_odom_body = {}};
    reading.T_odom_body = T_start_body(view_of(image_.load(std::memory_order_relaxed)));
    wires.odometry.push(reading);
    return true;
  }

 private:
  std::atomic<Doorbell*> bell_{nullptr};
  std::atomic<std::uint64_t> image_{0};
  std::atomic<std::int64_t> stamp_us_{-1};
  std::int64_t last_us_ = -1;
  std::uint64_t count_ = 0;
};

/// The camera's process: hands over an image in each interval until it is stopped.
class Camera {
 public:
  Camera(CameraServer server, const Views& views, double rate_hz, PromptOdometer& odometer, bench::Latencies& latencies)
      : server_(std::move(server)),
        views_(views),
        interval_(1.0 / rate_hz),
        odometer_(odometer),
        latencies_(latencies) {}

  void run(const std::stop_token& stop) {
    auto next = Clock::now();
    for (std::uint64_t image = 0; !stop.stop_requested();) {
      next += std::chrono::duration_cast<Clock::duration>(interval_);
      std::this_thread::sleep_until(next);
      server_.turn();
      if (server_.has_client()) send(image++);
    }
  }
  const CameraServerCounts& counts() const { return server_.counts(); }

 private:
  void send(std::uint64_t image) {
    const std::span<std::byte> slot = server_.next_frame();
    if (slot.empty()) return;
    std::ranges::copy(views_.at(view_of(image)), slot.begin());
    const auto now = std::chrono::duration_cast<Duration>(Clock::now().time_since_epoch());
    latencies_.handed_over(Stamp{now});
    server_.send_frame(Stamp{now});
    odometer_.image_taken(Stamp{now}, image);
  }

  CameraServer server_;
  const Views& views_;
  std::chrono::duration<double> interval_;
  PromptOdometer& odometer_;
  bench::Latencies& latencies_;
};

CameraServer serve(const std::filesystem::path& socket, const FrameFormat& format) {
  FileResult<CameraServer> server = CameraServer::listen(socket, {.format = format});
  if (!server) throw std::runtime_error(text(server.errors()));
  return *std::move(server);
}

Stages stages(const Rig& rig, std::vector<std::unique_ptr<Source>> sources, bench::Latencies& latencies) {
  Publisher publisher(PublishSettings{});  // multicast that stays on this machine
  publisher.listen([&](std::string_view channel, std::span<const std::byte> message, Stamp utime) {
    latencies.published(channel, message, utime);
  });
  return {.sources = std::move(sources),
          .perception = PerceptionStage(make_perception(rig.front_end, rig.camera, {}), PixelFormat::rgb8),
          .estimator = EstimatorStage(make_ekf_estimator(rig, EkfSettings{}), rig, StageSettings{}),
          .publisher = std::move(publisher)};
}

/// What of the images was lost where. Nothing waits anywhere but in the camera's few slots, which would be skipped.
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
  const Rig rig = rig_of(front_end);
  const Views views(rig, pixels);
  const std::filesystem::path socket =
      std::filesystem::temp_directory_path() / ("azimuth-bench-" + std::to_string(::getpid()) + ".sock");
  for (auto _ : state) {
    bench::Latencies latencies;
    std::vector<std::unique_ptr<Source>> sources;
    auto owned = std::make_unique<PromptOdometer>();
    PromptOdometer& odometer = *owned;
    sources.push_back(std::move(owned));
    sources.push_back(std::make_unique<SharedCameraSource>(socket, Duration{0}, 2s));
    Doorbell bell;
    Pipeline pipeline(stages(rig, std::move(sources), latencies), ThreadSettings{}, bell);
    Camera camera(serve(socket, views.format()), views, static_cast<double>(state.range(0)), odometer, latencies);
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
