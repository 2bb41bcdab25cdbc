// Publishes the messages of a daemon on a large map with the daemon's own publisher, for tests/bench/lookers.py, which
// measures the listeners. Sends 5,000 landmarks and a past of hours at once, then 15 images per second with one
// prediction between two images. The stamp of a pose is the time of sending.
//
// usage: large_map_sender SECONDS      writes "driving" when the past has been sent, and ends after SECONDS

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "daemon/publish/publisher.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int kLandmarks = 5'000, kAcross = 100, kSeen = 12;
constexpr int kPast = 95'000;  // stays below the limit of 100,000 kept poses for some minutes, so no thinning happens
constexpr double kBetween_m = 0.8, kSpeed_m_s = 1.0, kPosesPerSecond = 30.0, kLap_m = 150.0;
constexpr Duration kBetweenPoses{33'333};

Stamp wall_clock() {
  return Stamp{std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch())};
}

/// Rounds through the middle of the landmarks.
class Drive {
 public:
  Drive() {
    for (int i = 0; i < kLandmarks; ++i) {
      LandmarkEstimate& landmark = map_.emplace_back();
      landmark.id = i;
      landmark.p_map_landmark_m = {kBetween_m * (i % kAcross - kAcross / 2),
                                   kBetween_m * (i / kAcross - kLandmarks / kAcross / 2)};
      landmark.covariance_m2 = 0.01 * Eigen::Matrix2d::Identity();
    }
  }

  /// The next pose, stamped `stamp`.
  Estimate& go_on(Stamp stamp, bool predicted) {
    const double turn = 2.0 * kPi * static_cast<double>(estimate_.sequence) * (kSpeed_m_s / kPosesPerSecond) / kLap_m;
    const double radius_m = kLap_m / (2.0 * kPi);
    estimate_.stamp = stamp;
    ++estimate_.sequence;
    if (!predicted) ++estimate_.step;
    estimate_.predicted = predicted;
    estimate_.T_map_body = {radius_m * std::cos(turn), radius_m * std::sin(turn), wrap(turn + kPi / 2)};
    estimate_.T_odom_body = estimate_.T_map_body;
    estimate_.pose_covariance = Eigen::Vector3d(1e-3, 1e-3, 1e-4).asDiagonal();
    estimate_.health = Health::tracking;
    return estimate_;
  }

  /// The result of an image's step, which reduces the covariance of its landmarks a little.
  void look(StepResult& step, BearingSet& seen) {
    step.estimate = estimate_;
    step.estimate.accepted.clear();
    step.expected.stamp = seen.stamp = estimate_.stamp;
    step.expected.bearings.clear();
    seen.bearings.clear();
    ++seen.sequence;
    for (int k = 0; k < kSeen; ++k) {
      LandmarkEstimate& landmark = map_[static_cast<std::size_t>(next_++ % kLandmarks)];
      landmark.covariance_m2 *= 0.999;
      const Eigen::Vector2d off_m = landmark.p_map_landmark_m - estimate_.T_map_body.position();
      const double azimuth_rad = wrap(std::atan2(off_m.y(), off_m.x()) - estimate_.T_map_body.heading_rad);
      seen.bearings.push_back({.azimuth_rad = azimuth_rad});
      step.estimate.accepted.push_back({.landmark_id = landmark.id, .azimuth_rad = azimuth_rad, .sigma_rad = 0.01});
      step.expected.bearings.push_back(
          {.landmark = landmark.id, .azimuth_rad = azimuth_rad, .gate_rad = 0.03, .sigma_rad = 0.01});
    }
    step.estimate.association.accepted += kSeen;
    estimate_.association = step.estimate.association;
    step.estimate.landmarks = map_;
  }

 private:
  Estimate estimate_;
  std::vector<LandmarkEstimate> map_;
  int next_ = 0;
};

void send_past(Drive& drive, Publisher& publisher) {
  const Stamp now = wall_clock();
  for (int i = 0; i < kPast; ++i) {
    publisher.prediction(drive.go_on(now - (kPast - i) * kBetweenPoses, true));
    if (i % 10 == 9) std::this_thread::sleep_for(1ms);  // prevents an overflow of the listeners' buffers
  }
}

void send_present(Drive& drive, Publisher& publisher, std::chrono::seconds duration) {
  StepResult step;
  BearingSet seen;
  Status status;
  const auto begin = Clock::now();
  auto next = begin;
  for (std::uint64_t i = 0; next - begin < duration; ++i) {
    next += kBetweenPoses;
    std::this_thread::sleep_until(next);
    Estimate& estimate = drive.go_on(wall_clock(), i % 2 == 1);
    if (estimate.predicted) {
      publisher.prediction(estimate);
    } else {
      drive.look(step, seen);
      publisher.step(step);
      publisher.bearings(seen);
    }
    publisher.send_due(Clock::now(), status);
  }
}

void send(std::chrono::seconds duration) {
  Publisher publisher(PublishSettings{}, Duration{0});
  Drive drive;
  send_past(drive, publisher);
  std::puts("driving");
  std::fflush(stdout);
  send_present(drive, publisher, duration);
}

}  // namespace
}  // namespace azimuth

int main(int argc, char** argv) {
  const int seconds = argc == 2 ? std::atoi(argv[1]) : 0;
  if (seconds <= 0) {
    std::fputs("usage: large_map_sender SECONDS\n", stderr);
    return 2;
  }
  azimuth::send(std::chrono::seconds(seconds));
}
