// The latency that recording images adds to the poses: the same camera and pipeline take turns with and without
// recording, so that other load of the machine affects both equally. Also checks the recording: it must stay within the
// quota at all times, and a replay of raw images must give the same result.
//
// AZIMUTH_BENCH_S: seconds per turn; AZIMUTH_BENCH_TURNS: turns of each kind; AZIMUTH_BENCH_FOLDER: folder of the
// recording (by default below /tmp); AZIMUTH_BENCH_QUOTA_MB: quota of the images.

#include <algorithm>
#include <array>
#include <benchmark/benchmark.h>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "daemon/devices/camera_source.hpp"
#include "daemon/pipeline/pipeline.hpp"
#include "drivers/storage/session.hpp"
#include "slam/perception/make_perception.hpp"
#include "slam/planar/make_ekf_estimator.hpp"
#include "tests/bench/camera_process.hpp"
#include "tests/bench/latencies.hpp"
#include "tests/bench/quantiles.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr double kRate_hz = 15.0;

double number_of(const char* variable, double otherwise) {
  const char* const value = std::getenv(variable);
  return value ? std::strtod(value, nullptr) : otherwise;
}

struct Plan {
  double turn_s = number_of("AZIMUTH_BENCH_S", 10.0);
  int turns = static_cast<int>(number_of("AZIMUTH_BENCH_TURNS", 2.0));
  double quota_mb = number_of("AZIMUTH_BENCH_QUOTA_MB", 4000.0);
  fs::path folder = std::getenv("AZIMUTH_BENCH_FOLDER")
                        ? fs::path(std::getenv("AZIMUTH_BENCH_FOLDER"))
                        : fs::temp_directory_path() / ("azimuth-bench-" + std::to_string(::getpid()));
};

std::uintmax_t bytes_of_frames(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  std::error_code gone;  // set if a file disappears meanwhile
  for (fs::directory_iterator session(folder, gone), end; !gone && session != end; session.increment(gone))
    for (const SegmentFile& segment : session_segments(session->path() / kFramesPart)) {
      const std::uintmax_t size = fs::file_size(segment.file, gone);
      if (!gone) bytes += size;
    }
  return bytes;
}

/// Result of one turn.
struct Turn {
  std::vector<double> latencies_us;
  double largest_mb = 0.0;
  std::uint64_t lost = 0, frames = 0, digest = 0;
};

class Bench {
 public:
  explicit Bench(const Plan& plan)
      : plan_(plan), rig_(bench::rig_of(FrontEnd::colour)), views_(rig_, PixelFormat::yuyv) {}

  Turn turn(RecordedFrames frames) const {
    Turn turn;
    bench::Latencies latencies;
    std::vector<std::unique_ptr<Source>> sources;
    auto owned = std::make_unique<bench::PromptOdometer>();
    bench::PromptOdometer& odometer = *owned;
    sources.push_back(std::move(owned));
    sources.push_back(std::make_unique<SharedCameraSource>(bench::camera_socket(), Duration{0}, 2s));
    Doorbell bell;
    Pipeline pipeline(stages(frames, std::move(sources), latencies), ThreadSettings{}, bell);
    bench::Camera camera(bench::serve(bench::camera_socket(), views_.format()), views_, kRate_hz, odometer, latencies);
    pipeline.start();
    {
      const std::jthread process([&](const std::stop_token& stop) { camera.run(stop); });
      const auto end = bench::Clock::now() + std::chrono::duration<double>(plan_.turn_s);
      while (bench::Clock::now() < end) {
        std::this_thread::sleep_for(100ms);
        turn.largest_mb = std::max(turn.largest_mb, 1e-6 * static_cast<double>(bytes_of_frames(plan_.folder)));
      }
    }
    pipeline.stop();
    turn.latencies_us = latencies.take();
    turn.frames = camera.counts().frames;
    turn.lost = pipeline.losses().records_refused + pipeline.losses().frames_replaced;
    turn.digest = pipeline.digest().value();
    return turn;
  }

  /// Returns 1 if a replay of the raw images gives the same digest, else 0; -1: the quota has removed some of the
  /// images.
  int same_digest(const Turn& turn) const {
    const fs::path session = fs::directory_iterator(plan_.folder)->path();
    FileResult<Run> run = load_run(session);
    if (!run || run->skipped.missing_frame_segments > 0) return -1;
    const ReplayResult replayed =
        replay_images(*run, rig_, {make_perception(rig_.front_end, rig_.camera, {}), PixelFormat::rgb8},
                      make_ekf_estimator(rig_, EkfSettings{}), StageSettings{});
    return replayed.digest == turn.digest ? 1 : 0;
  }
  void clear() const { fs::remove_all(plan_.folder); }

 private:
  Stages stages(RecordedFrames frames, std::vector<std::unique_ptr<Source>> sources,
                bench::Latencies& latencies) const {
    RecordSettings record;
    record.folder = plan_.folder;
    record.frames = frames;
    record.frames_quota_mb = plan_.quota_mb;
    const EventTimes times = EventTimes::live(Duration{0});
    Publisher publisher(PublishSettings{});
    publisher.listen([&](std::string_view channel, std::span<const std::byte> message, Stamp utime) {
      latencies.published(channel, message, utime);
    });
    Stages stages{.sources = std::move(sources),
                  .perception = PerceptionStage(make_perception(rig_.front_end, rig_.camera, {}), PixelFormat::rgb8),
                  .estimator = EstimatorStage(make_ekf_estimator(rig_, EkfSettings{}), rig_, StageSettings{}),
                  .publisher = std::move(publisher)};
    stages.recorder.emplace(record, std::vector<Document>{{"rig.toml", "# that of the bench\n"}}, times);
    if (frames != RecordedFrames::none) stages.frame_recorder.emplace(record, times);
    return stages;
  }

  const Plan& plan_;
  Rig rig_;
  bench::Views views_;
};

constexpr std::array kForms{std::pair{RecordedFrames::none, "none"}, std::pair{RecordedFrames::jpeg, "jpeg"},
                            std::pair{RecordedFrames::raw, "raw"}};

/// `times_us` must be sorted.
double quantile_of(const std::vector<double>& times_us, double share) {
  if (times_us.empty()) return 0.0;
  return times_us[static_cast<std::size_t>(share * static_cast<double>(times_us.size() - 1))];
}

void recording_1024x768_yuyv_15_hz(benchmark::State& state) {
  const Plan plan;
  const Bench bench(plan);
  std::map<RecordedFrames, std::vector<double>> latencies_us;
  int same_digest = 1;
  for (auto _ : state) {
    for (int i = 0; i < plan.turns * static_cast<int>(kForms.size()); ++i) {
      const auto& [form, name] = kForms[static_cast<std::size_t>(i) % kForms.size()];
      bench.clear();
      const Turn turn = bench.turn(form);
      if (form == RecordedFrames::raw) same_digest = std::min(same_digest, bench.same_digest(turn));
      std::vector<double>& all = latencies_us[form];
      all.insert(all.end(), turn.latencies_us.begin(), turn.latencies_us.end());
      state.counters["images"] += static_cast<double>(turn.frames);
      state.counters["lost"] += static_cast<double>(turn.lost);
      state.counters["largest_mb"] = std::max(state.counters["largest_mb"].value, turn.largest_mb);
    }
  }
  bench.clear();
  for (const auto& [form, name] : kForms) {
    std::ranges::sort(latencies_us[form]);
    state.counters[std::string("p50_us_") + name] = quantile_of(latencies_us[form], 0.5);
    state.counters[std::string("p99_us_") + name] = quantile_of(latencies_us[form], 0.99);
  }
  state.counters["same_digest"] = same_digest;
}
BENCHMARK(recording_1024x768_yuyv_15_hz)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace azimuth
