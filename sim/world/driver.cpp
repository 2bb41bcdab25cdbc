#include "sim/world/driver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace azimuth {
namespace {

double direction(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return std::atan2(to.y() - from.y(), to.x() - from.x());
}

/// A path parametrised by its length.
class Polyline {
 public:
  explicit Polyline(const Path& path) {
    assert(!path.empty());
    for (const Eigen::Vector2d& corner : path) {
      const double step_m = corners_.empty() ? 0.0 : (corner - corners_.back()).norm();
      if (!corners_.empty() && step_m == 0.0) continue;
      lengths_m_.push_back(length_m() + step_m);
      corners_.push_back(corner);
    }
    assert(corners_.size() >= 2);
  }

  double length_m() const { return lengths_m_.empty() ? 0.0 : lengths_m_.back(); }

  Eigen::Vector2d point(double s_m) const {
    const std::size_t end = segment_end(s_m);
    const double leg_m = lengths_m_[end] - lengths_m_[end - 1];
    const double fraction = std::clamp((s_m - lengths_m_[end - 1]) / leg_m, 0.0, 1.0);
    return corners_[end - 1] + fraction * (corners_[end] - corners_[end - 1]);
  }

  double heading_rad(double s_m) const {
    const std::size_t end = segment_end(s_m);
    return direction(corners_[end - 1], corners_[end]);
  }

  Pose2 start() const { return {corners_.front().x(), corners_.front().y(), wrap(heading_rad(0.0))}; }

 private:
  std::size_t segment_end(double s_m) const {
    const auto found = std::upper_bound(lengths_m_.begin(), lengths_m_.end(), s_m);
    return std::clamp<std::size_t>(static_cast<std::size_t>(found - lengths_m_.begin()), 1, lengths_m_.size() - 1);
  }

  std::vector<Eigen::Vector2d> corners_;
  std::vector<double> lengths_m_;  // From the start to each corner
};

class StepDriver final : public Driver {
 public:
  StepDriver(const StepDrive& settings, const Path& path, const Random& random)
      : settings_(settings), path_(path), random_(random) {}

  Pose2 start() const override { return path_.start(); }

  std::optional<Control> next(const Pose2& T_world_body) override {
    if (step_ == settings_.steps) return std::nullopt;
    ++step_;
    const double s_m = std::fmod(step_ * settings_.step_m, path_.length_m());
    const double aside_x_m = random_.normal(settings_.sigma_aim_m);
    const double aside_y_m = random_.normal(settings_.sigma_aim_m);
    const Eigen::Vector2d stop = path_.point(s_m) + Eigen::Vector2d{aside_x_m, aside_y_m};
    const double heading_rad = path_.heading_rad(s_m) + random_.normal(settings_.sigma_heading_rad);
    const double drive_rad = direction(T_world_body.position(), stop);
    return Control{(stop - T_world_body.position()).norm(), wrap(drive_rad - T_world_body.heading_rad),
                   wrap(heading_rad - drive_rad)};
  }

 private:
  StepDrive settings_;
  Polyline path_;
  Random random_;
  int step_ = 0;
};

class SmoothDriver final : public Driver {
 public:
  SmoothDriver(const SmoothDrive& settings, const Path& path) : settings_(settings), path_(path) {}

  Pose2 start() const override { return path_.start(); }

  std::optional<Control> next(const Pose2& T_world_body) override {
    move_carrot(T_world_body.position());
    const Eigen::Vector2d carrot = path_.point(carrot_m_);
    const double distance_m = (carrot - T_world_body.position()).norm();
    const bool at_end = carrot_m_ >= path_.length_m();
    const double off_rad = wrap(direction(T_world_body.position(), carrot) - T_world_body.heading_rad);
    if (at_end && (distance_m < kArrived_m || std::abs(off_rad) > kPi / 2)) return std::nullopt;

    set_speed(off_rad, path_.length_m() - carrot_m_ + distance_m);
    // Pure pursuit: the arc that is tangent to the heading and meets the target point on the path.
    const double curvature_per_m = 2.0 * std::sin(off_rad) / std::max(distance_m, settings_.look_ahead_m / 2);
    // A target behind the robot has no useful curvature, so the robot turns towards it at the maximum rate.
    const double wanted_rate =
        std::abs(off_rad) > kPi / 2 ? std::copysign(INFINITY, off_rad) : speed_ * curvature_per_m;
    const double limit = settings_.max_turn_rate_rad_per_s;
    const double turn_rad = std::clamp(wanted_rate, -limit, limit) * settings_.tick_s;
    return Control{speed_ * settings_.tick_s, turn_rad / 2, turn_rad / 2};
  }

 private:
  static constexpr double kArrived_m = 0.02;

  /// Moves the target point ahead of the robot along the path; it never moves back.
  void move_carrot(const Eigen::Vector2d& position) {
    constexpr double kStep_m = 0.005;
    while (carrot_m_ < path_.length_m() && (path_.point(carrot_m_) - position).norm() < settings_.look_ahead_m)
      carrot_m_ += kStep_m;
  }

  void set_speed(double off_rad, double to_go_m) {
    const double turning = std::max(0.15, std::cos(off_rad));  // Slows down where the path bends
    const double stopping = std::sqrt(2.0 * settings_.acceleration_m_per_s2 * to_go_m);
    const double wanted = std::min(settings_.speed_m_per_s * turning, stopping);
    const double most = settings_.acceleration_m_per_s2 * settings_.tick_s;
    speed_ += std::clamp(wanted - speed_, -2.0 * most, most);
  }

  SmoothDrive settings_;
  Polyline path_;
  double carrot_m_ = 0.0;
  double speed_ = 0.0;  // m/s
};

}  // namespace

double tick_s(const DriveSettings& settings) {
  if (const auto* steps = std::get_if<StepDrive>(&settings)) return steps->period_s;
  return std::get<SmoothDrive>(settings).tick_s;
}

Pose2 displacement(const Control& control) {
  return {control.distance_m * std::cos(control.first_turn_rad), control.distance_m * std::sin(control.first_turn_rad),
          wrap(control.first_turn_rad + control.second_turn_rad)};
}

std::unique_ptr<Driver> make_driver(const DriveSettings& settings, const Path& path, const Random& random) {
  if (const auto* steps = std::get_if<StepDrive>(&settings)) return std::make_unique<StepDriver>(*steps, path, random);
  return std::make_unique<SmoothDriver>(std::get<SmoothDrive>(settings), path);
}

}  // namespace azimuth
