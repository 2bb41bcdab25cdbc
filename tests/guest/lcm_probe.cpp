// lcm_probe: what a daemon publishes, for scripts. `lcm_probe --help` says how.

#include <CLI/CLI.hpp>
#include <azimuth/pose_cov_t.hpp>
#include <azimuth/status_t.hpp>
#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <stdexcept>

#include "drivers/io/channels.hpp"

namespace {

using azimuth::pose_cov_t;
using azimuth::status_t;
using Clock = std::chrono::steady_clock;

constexpr double kTurn_s = 0.1;

struct ProbeWords {
  std::string url = "udpm://239.255.76.67:7667?ttl=0", prefix, file;
  double seconds = 10.0, since_s = -1.0;
};

double monotonic_s() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

/// Hears poses and statuses.
class Probe {
 public:
  explicit Probe(const ProbeWords& words) : lcm_(words.url) {
    if (!lcm_.good()) throw std::runtime_error(words.url + ": cannot be opened");
    lcm_.subscribeFunction(words.prefix + std::string(azimuth::channel::kPose), hear_pose, this);
    lcm_.subscribeFunction(words.prefix + std::string(azimuth::channel::kStatus), hear_status, this);
  }
  /// Until `done`, which is asked after each message, or until the time is up: false.
  template <class Condition>
  bool listen(double seconds, const Condition& done) {
    const double end_s = monotonic_s() + seconds;
    while (monotonic_s() < end_s) {
      if (lcm_.handleTimeout(static_cast<int>(1e3 * kTurn_s)) > 0 && done()) return true;
    }
    return false;
  }

  std::unique_ptr<pose_cov_t> pose;  ///< of the last message, if it was one
  std::unique_ptr<status_t> status;

 private:
  static void hear_pose(const lcm::ReceiveBuffer*, const std::string&, const pose_cov_t* pose, Probe* self) {
    self->status.reset();
    self->pose = std::make_unique<pose_cov_t>(*pose);
  }
  static void hear_status(const lcm::ReceiveBuffer*, const std::string&, const status_t* status, Probe* self) {
    self->pose.reset();
    self->status = std::make_unique<status_t>(*status);
  }

  lcm::LCM lcm_;
};

/// One row a pose, as it came.
int write_poses(const ProbeWords& words) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(words.file.c_str(), "w"), &std::fclose);
  if (!file) throw std::system_error(errno, std::generic_category(), words.file);
  fmt::print(file.get(), "utime,utime_mono,arrived_mono,seq,x_m,y_m,heading_rad,health,predicted,step\n");
  Probe probe(words);
  std::uint64_t poses = 0;
  probe.listen(words.seconds, [&] {
    if (!probe.pose) return false;
    const pose_cov_t& pose = *probe.pose;
    fmt::print(file.get(), "{},{},{:.0f},{},{},{},{},{},{:d},{}\n", pose.utime, pose.utime_mono, 1e6 * monotonic_s(),
               pose.seq, pose.x_m, pose.y_m, pose.heading_rad, static_cast<int>(pose.health), pose.predicted != 0,
               pose.step);
    ++poses;
    return false;
  });
  fmt::print("poses={}\n", poses);
  return poses > 0 ? 0 : 1;
}

/// By a step whose image was taken after the given moment, so that camera, odometry and estimator work again.
int await_tracking(const ProbeWords& words) {
  const double start_s = monotonic_s(), since_s = words.since_s >= 0.0 ? words.since_s : start_s;
  Probe probe(words);
  const bool tracks = probe.listen(words.seconds, [&] {
    return probe.pose && probe.pose->predicted == 0 && probe.pose->health == pose_cov_t::HEALTH_TRACKING &&
           static_cast<double>(probe.pose->utime_mono) > 1e6 * since_s;
  });
  fmt::print("{:.3f}\n", monotonic_s() - since_s);
  return tracks ? 0 : 1;
}

void print_status(const status_t& status) {
  const auto line = [](const char* name, const auto& value) { fmt::print("{}={}\n", name, value); };
  line("health", static_cast<int>(status.health));
  line("reason", status.reason);
  line("estimates", status.estimates);
  line("steps", status.steps);
  line("landmarks", status.landmarks);
  line("accepted", status.accepted);
  line("odometry_gaps", status.odometry_gaps);
  line("bearing_gaps", status.bearing_gaps);
  line("odometry_refused", status.odometry_refused);
  line("frames", status.frames);
  line("frames_replaced", status.frames_replaced);
  line("frames_unusable", status.frames_unusable);
  line("image_trouble", status.image_trouble);
  line("odometer", status.odometer);
  line("camera", status.camera);
  line("recorder", status.recorder);
  line("odometer_reconnects", status.odometer_reconnects);
  line("camera_reconnects", status.camera_reconnects);
  line("camera_missing", status.camera_missing);
  line("camera_corrupt", status.camera_corrupt);
  line("battery_v", status.battery_v);
  line("robot_flags", status.robot_flags);
}

int show_status(const ProbeWords& words) {
  Probe probe(words);
  const bool heard = probe.listen(words.seconds, [&] { return probe.status != nullptr; });
  if (heard) print_status(*probe.status);
  return heard ? 0 : 1;
}

int run(int argc, char** argv) {
  ProbeWords words;
  CLI::App app("What a daemon publishes. Exit code 1: not heard in time.");
  app.add_option("--url", words.url, "Of the LCM network")->capture_default_str();
  app.add_option("--prefix", words.prefix, "Of the daemon's channels");
  app.require_subcommand(1);
  const auto add_seconds = [&](CLI::App* one, const char* what) {
    one->add_option("SECONDS", words.seconds, what)->check(CLI::PositiveNumber)->capture_default_str();
  };
  CLI::App* poses = app.add_subcommand("poses", "Write poses to a CSV file for so long");
  poses->add_option("FILE", words.file)->required();
  add_seconds(poses, "How long");
  CLI::App* tracking = app.add_subcommand("await-tracking", "Wait for a pose that tracks; prints the seconds waited");
  add_seconds(tracking, "How long at most");
  tracking->add_option("--since", words.since_s, "Only images after this moment count, s on CLOCK_MONOTONIC (now)");
  CLI::App* status = app.add_subcommand("status", "The next status, as lines of key=value");
  add_seconds(status, "How long to wait at most");
  CLI11_PARSE(app, argc, argv);
  if (*poses) return write_poses(words);
  return *tracking ? await_tracking(words) : show_status(words);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lcm_probe: %s\n", error.what());
    return 1;
  }
}
