// Latency from handing a bearing set to the pipeline to its pose on LCM. Two threads wake up on the way, so the
// machine's own wake-up latency, which is also measured, is the lower limit.

#include <benchmark/benchmark.h>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "daemon/pipeline/pipeline.hpp"
#include "slam/planar/ekf_estimator.hpp"
#include "tests/bench/latencies.hpp"
#include "tests/bench/quantiles.hpp"
#include "tests/bench/world.hpp"

namespace azimuth {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kImageInterval = std::chrono::microseconds(66'667);
constexpr int kAtOnce = 20;  // landmarks per image while the map is built

/// A robot that moves back and forth. It first builds the map as fast as possible, then sends images at their rate,
/// each with its odometry.
class ToAndFro final : public Source {
 public:
  ToAndFro(int landmarks, int images, bench::Latencies& latencies)
      : landmarks_(bench::make_landmarks(landmarks)), images_(images), latencies_(latencies) {}

  const char* name() const override { return "bench"; }
  void restore(const OdometerMemory& /*memory*/) override {}

  bool turn(Doorbell& bell, SourceWires& wires) override {
    const auto count = static_cast<int>(landmarks_.size());
    if (mapped_ < count) {
      bell.wait(1ms);  // gives the estimator time
      map(wires);
      return true;
    }
    bell.wait(next_image_ - Clock::now());
    if (Clock::now() < next_image_) return true;
    next_image_ = Clock::now() + kImageInterval;
    if (sent_ == images_) return false;
    drive(sent_++ % 2 == 0 ? bench::kStride_m : -bench::kStride_m, wires);
    look(0, bench::kSeen);
    latencies_.handed_over(set_.stamp);
    wires.bearings->push(set_);
    return true;
  }

 private:
  void map(SourceWires& wires) {
    const int last = std::min(static_cast<int>(landmarks_.size()), mapped_ + kAtOnce);
    for (const double distance_m : {0.0, bench::kBaseline_m}) {
      drive(distance_m, wires);
      look(mapped_, last);
      wires.bearings->push(set_);
    }
    drive(-bench::kBaseline_m, wires);
    mapped_ = last;
  }

  void drive(double distance_m, SourceWires& wires) {
    x_m_ += distance_m;
    now_ += Duration{100'000};
    OdometryReading reading{.stamp = now_, .sequence = sequence_++, .T_odom_body = {x_m_, 0.0, 0.0}};
    wires.odometry.push(reading);
  }

  /// Sends bearings to the landmarks [first, last), stamped just before the newest reading.
  void look(int first, int last) {
    set_.bearings.clear();
    set_.stamp = now_ - Duration{1};
    set_.sequence = images_seen_++;
    for (int i = first; i < last; ++i)
      set_.bearings.push_back(
          {.azimuth_rad = bench::azimuth_to({x_m_, 0.0, 0.0}, landmarks_[static_cast<std::size_t>(i)]), .identity = i});
  }

  std::vector<Eigen::Vector2d> landmarks_;
  int images_, mapped_ = 0, sent_ = 0;
  bench::Latencies& latencies_;
  Clock::time_point next_image_{};
  Stamp now_{};
  std::uint64_t sequence_ = 0, images_seen_ = 0;
  double x_m_ = 0.0;
  BearingSet set_;
};

std::unique_ptr<Estimator> estimator() {
  Rig rig;
  rig.camera.sigma_bearing_rad = bench::kSigmaBearing_rad;
  rig.camera.identities = true;
  EkfSettings settings;
  settings.initialisation = Initialisation::delayed;
  settings.delayed.kl_threshold = 1e3;  // initialises the map from two poses, whatever its quality
  settings.delayed.kl_samples = 10;
  settings.thinning_s = 0.0;
  return std::make_unique<EkfEstimator>(rig, settings);
}

/// Thread settings of the service's azimuthd.toml.
ThreadSettings real_time() {
  ThreadSettings threads;
  threads.source.fifo_priority = 40;
  threads.estimator.fifo_priority = 30;
  threads.publisher.fifo_priority = 10;
  return threads;
}

/// `echo`: also publishes samples, sightings and expectations, which is the daemon's default. `fifo`: uses real-time
/// scheduling.
void bearings_to_pose_sent(benchmark::State& state) {
  const bool echo = state.range(1) != 0, fifo = state.range(2) != 0;
  for (auto _ : state) {
    bench::Latencies latencies;
    PublishSettings publish;  // the multicast stays on this machine
    publish.map_rate_hz = 0.0;
    publish.echo_samples = echo;
    Publisher publisher(publish);
    publisher.listen([&](std::string_view channel, std::span<const std::byte> message, Stamp utime) {
      latencies.published(channel, message, utime);
    });
    std::vector<std::unique_ptr<Source>> sources;
    sources.push_back(std::make_unique<ToAndFro>(static_cast<int>(state.range(0)), 150, latencies));
    Doorbell bell;
    Pipeline pipeline({.sources = std::move(sources),
                       .estimator = EstimatorStage(estimator(), Rig{}, StageSettings{}),
                       .publisher = std::move(publisher),
                       .echo_samples = echo},
                      fifo ? real_time() : ThreadSettings{}, bell);
    pipeline.start();
    Status status;
    while (!pipeline.finished()) bell.wait(100ms);
    pipeline.stop();
    if (pipeline.take_status(status)) state.counters["mapped"] = static_cast<double>(status.landmarks);
    bench::count_quantiles(state, latencies.take());
  }
}
BENCHMARK(bearings_to_pose_sent)
    ->ArgNames({"landmarks", "echo", "fifo"})
    ->Args({100, 0, 0})
    ->Args({100, 1, 0})
    ->Args({100, 1, 1})
    ->Iterations(1)
    ->Unit(benchmark::kSecond);

/// The machine's own latency: two idle threads that wake up one after the other at the rate of images.
void wake_up_twice(benchmark::State& state) {
  for (auto _ : state) {
    std::vector<double> latencies_us;
    Doorbell first, second, third;
    const auto pass_on = [](Doorbell& from, Doorbell& to, const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        from.wait(10s);
        to.ring();
      }
    };
    std::jthread a([&](const std::stop_token& stop) { pass_on(first, second, stop); });
    std::jthread b([&](const std::stop_token& stop) { pass_on(second, third, stop); });
    for (int i = 0; i < 150; ++i) {
      std::this_thread::sleep_for(kImageInterval);
      const auto start = Clock::now();
      first.ring();
      third.wait(1s);
      latencies_us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
    }
    a.request_stop();
    b.request_stop();
    first.ring();
    a.join();
    second.ring();
    bench::count_quantiles(state, std::move(latencies_us));
  }
}
BENCHMARK(wake_up_twice)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace azimuth
