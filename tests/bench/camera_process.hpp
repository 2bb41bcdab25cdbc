#pragma once
// A camera as the pipeline sees one in another process: the real link, with images rendered in advance, and an odometer
// without delay.

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include "daemon/pipeline/source.hpp"
#include "drivers/camera/camera_server.hpp"
#include "sim/renderer/renderer.hpp"
#include "sim/renderer/standard_cameras.hpp"
#include "slam/estimator/rig.hpp"
#include "tests/bench/latencies.hpp"

namespace azimuth::bench {

using Clock = std::chrono::steady_clock;

inline constexpr int kViews = 60;  // number of places along the robot's path
inline constexpr double kBetweenViews_m = 0.033;

inline Pose2 T_start_body(int view) { return {kBetweenViews_m * view, 0.0, 0.0}; }

inline Rig rig_of(FrontEnd front_end) {
  Rig rig;
  rig.front_end = front_end;
  rig.camera = *standard_camera("mirror");
  if (front_end != FrontEnd::sift) return rig;
  ImageRig& image = rig.camera.image;  // the same mirror, fully visible, in a square image
  const double scale = 235.0 / *image.mask_outer_px;
  image.width_px = image.height_px = 480;
  image.centre_px = PixelPoint{239.5, 239.5};
  std::get<HyperbolicMirrorRig>(rig.camera.model).focal_length_px *= scale;
  for (std::optional<double>* length : {&image.mask_inner_px, &image.mask_outer_px}) **length *= scale;
  return rig;
}

/// The images at all places of the path.
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

/// The place of the n-th image on the path back and forth.
inline int view_of(std::uint64_t image) {
  const int place = static_cast<int>(image % (2 * kViews - 2));
  return place < kViews ? place : 2 * kViews - 2 - place;
}

/// An odometer that reports the pose of the newest image at once.
class PromptOdometer final : public Source {
 public:
  const char* name() const override { return "odometer"; }
  void restore(const OdometerMemory& /*memory*/) override {}

  void image_taken(Stamp stamp, std::uint64_t number) {
    image_.store(number, std::memory_order_relaxed);
    stamp_us_.store(to_us(stamp), std::memory_order_release);
    if (Doorbell* bell = bell_.load()) bell->ring();
  }
  bool turn(Doorbell& bell, SourceWires& wires) override {
    bell_ = &bell;
    bell.wait(std::chrono::milliseconds(100));
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

/// The camera's process: sends an image in each interval until it is stopped.
class Camera {
 public:
  Camera(CameraServer server, const Views& views, double rate_hz, PromptOdometer& odometer, Latencies& latencies)
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
  Latencies& latencies_;
};

inline CameraServer serve(const std::filesystem::path& socket, const FrameFormat& format) {
  FileResult<CameraServer> server = CameraServer::listen(socket, {.format = format});
  if (!server) throw std::runtime_error(text(server.error()));
  return *std::move(server);
}

/// One socket per process.
inline std::filesystem::path camera_socket() {
  return std::filesystem::temp_directory_path() / ("azimuth-bench-" + std::to_string(::getpid()) + ".sock");
}

}  // namespace azimuth::bench
