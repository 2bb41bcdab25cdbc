#include "tests/support/encoder_robot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <utility>
#include <vector>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/random.hpp"

namespace azimuth {
namespace {

constexpr double kTick_s = 0.01;
constexpr int kTicksOfOdometry = 5, kTicksOfImage = 20;
constexpr double kSpeed_m_s = 0.4, kMostTurn_rad_s = 0.9;
constexpr double kBase_m = 0.33, kPerCount_m = 2.0 * kPi * 0.0975 / 19105.0;
constexpr double kSigmaBearing_rad = 0.0175, kSeenWithin_m = 6.0, kDetected = 0.8, kJitter_s = 0.004;
constexpr int kLandmarks = 14;
// Correlated noise of the speeds. Over metres it adds up to as much as the uncorrelated noise that the rig states.
constexpr double kLasts_s = 1.0, kSigmaSpeed_m_s = 0.0084, kSigmaTurn_rad_s = 0.0132;
constexpr double kNextDoor_m = 18.0, kWall_m = 9.0, kCarried_m_s = 1.0, kCarriedTurn_rad_s = 0.4;  // along x
constexpr double kSlipInTurns = 0.02, kCarpetFrom_m = 2.0, kCarpetPulls_rad_per_m = 0.01;

constexpr const char* kRig = R"(front_end = "bearings"
[camera]
model = "bearings"
sigma_bearing_rad = 0.0175
identities = {}
[odometry]
kind = "wheel_pose"
lambda_distance_m = 4e-4
lambda_rotation_rad = 1e-3
lambda_drift_rad2_per_m = 1e-3
)";

using Numbers = RandomNumbers<Xoshiro>;

/// Correlated noise (Ornstein-Uhlenbeck process).
class Lasting {
 public:
  double next(double sigma, Numbers& numbers) {
    const double kept = std::exp(-kTick_s / kLasts_s);
    value_ = kept * value_ + sigma * std::sqrt(1.0 - kept * kept) * numbers.normal(1.0);
    return value_;
  }

 private:
  double value_ = 0.0;
};

/// Noise of standard deviation `sigma` with the heavy tails of a Laplace distribution.
double heavy_tailed(double sigma, Numbers& numbers) {
  const double u = numbers.uniform() - 0.5;
  return -std::copysign(sigma / std::sqrt(2.0) * std::log(1.0 - 2.0 * std::min(std::abs(u), 0.4999999)), u);
}

class Drive {
 public:
  explicit Drive(const EncoderRobot& robot) : robot_(robot), numbers_(Xoshiro(robot.seed)) {
    place_landmarks(0.0);
    const auto is_next_door = [](const Carrying& carrying) { return carrying.next_door; };
    if (std::ranges::any_of(robot.carried, is_next_door)) place_landmarks(kNextDoor_m);
  }

  Run run() {
    Run run;
    run.name = "encoder robot";
    run.rig_toml = fmt::format(kRig, robot_.names);
    run.rig_file = "rig.toml";
    for (int i = 0; i < kLandmarks && robot_.names; ++i)
      run.landmarks.push_back({.identity = i,
                               .x_m = landmarks_[static_cast<std::size_t>(i)].x(),
                               .y_m = landmarks_[static_cast<std::size_t>(i)].y(),
                               .kind = {}});
    T_world_body_ = {-2.5, -2.2, 0.0};
    drive_laps(run);
    for (const Carrying& carrying : robot_.carried) {
      carry(carrying, run);
      set_down.push_back(stamp());
      drive_laps(run);
    }
    return run;
  }

  std::vector<Stamp> set_down;

 private:
  Stamp stamp() const { return Stamp{duration_from_seconds(tick_ * kTick_s)}; }

  void place_landmarks(double x_m) {
    for (int i = 0; i < kLandmarks; ++i)
      landmarks_.emplace_back(x_m + numbers_.uniform(-4.5, 4.5), numbers_.uniform(-3.5, 3.5));
  }

  void drive_laps(Run& run) {
    const std::array<Eigen::Vector2d, 6> corners{
        {{2.5, -2.2}, {3.0, 0.0}, {2.5, 2.2}, {-2.5, 2.2}, {-1.5, 0.0}, {-2.5, -2.2}}};
    const Eigen::Vector2d room(T_world_body_.x_m > kWall_m ? kNextDoor_m : 0.0, 0.0);
    const int last = robot_.laps * static_cast<int>(corners.size());
    bool stood = false;
    for (int corner = 0; corner < last;) {
      if (!std::exchange(stood, stood || 2 * corner >= last) && stood) stand(run);
      tell(run, true);
      const Eigen::Vector2d target = room + corners[static_cast<std::size_t>(corner) % corners.size()];
      if ((target - T_world_body_.position()).norm() < 0.4) ++corner;
      go(target);
    }
  }

  void stand(Run& run) {
    for (double left_s = robot_.stands_s; left_s > 0.0; left_s -= kTick_s) {
      tell(run, true);
      T_odom_body_ = T_odom_body_ * Pose2{robot_.creeps_m_per_s * kTick_s, 0.0, 0.0};
    }
  }

  /// Records the sensor readings of this instant.
  void tell(Run& run, bool with_images) {
    if (tick_ % kTicksOfOdometry == 0) {
      run.odometry.push_back({.stamp = stamp(), .T_odom_body = T_odom_body_});
      run.truth.push_back({stamp(), T_world_body_});
    }
    past_.push_front(T_world_body_);
    if (past_.size() > 200) past_.pop_back();
    if (with_images && tick_ % kTicksOfImage == 7) run.bearings.push_back(seen(stamp()));
    ++tick_;
  }

  void carry(const Carrying& carrying, Run& run) {
    const Eigen::Vector2d to(numbers_.uniform(-2.5, 2.5) + (carrying.next_door ? kNextDoor_m : 0.0),
                             numbers_.uniform(-2.0, 2.0));
    const double turn_rad_s = numbers_.uniform(-kCarriedTurn_rad_s, kCarriedTurn_rad_s);
    const double step_m = kCarried_m_s * kTick_s;
    while ((to - T_world_body_.position()).norm() > step_m) {
      tell(run, !carrying.camera_covered);
      const Eigen::Vector2d p = T_world_body_.position() + step_m * (to - T_world_body_.position()).normalized();
      T_world_body_ = {p.x(), p.y(), wrap(T_world_body_.heading_rad + turn_rad_s * kTick_s)};
    }
    past_.clear();  // an image shows the world either before or after the carrying
  }

  void go(const Eigen::Vector2d& target) {
    const Eigen::Vector2d towards = inverse(T_world_body_) * target;
    const double off_rad = std::atan2(towards.y(), towards.x());
    const double turn_rad_s = std::clamp(1.5 * off_rad, -kMostTurn_rad_s, kMostTurn_rad_s);
    const double speed_m_s = kSpeed_m_s * std::max(0.15, std::cos(off_rad));
    const double noise = robot_.odometry_noise;
    // Counts the wheel motion, then moves the robot with slip and noise.
    count(speed_m_s, turn_rad_s);
    double v = speed_m_s + speed_.next(noise * kSigmaSpeed_m_s, numbers_);
    double w =
        (1.0 - noise * kSlipInTurns * numbers_.uniform()) * turn_rad_s + turn_.next(noise * kSigmaTurn_rad_s, numbers_);
    w += robot_.drift_rad_per_m * v;
    if (T_world_body_.x_m > kCarpetFrom_m) w += noise * kCarpetPulls_rad_per_m * v;
    const double half_rad = 0.5 * w * kTick_s;
    T_world_body_ =
        T_world_body_ * Pose2{v * kTick_s * std::cos(half_rad), v * kTick_s * std::sin(half_rad), 2 * half_rad};
  }

  void count(double speed_m_s, double turn_rad_s) {
    const double left_m = (speed_m_s - 0.5 * kBase_m * turn_rad_s) * kTick_s + left_over_m_;
    const double right_m = (speed_m_s + 0.5 * kBase_m * turn_rad_s) * kTick_s + right_over_m_;
    const double left = std::floor(left_m / kPerCount_m) * kPerCount_m;
    const double right = std::floor(right_m / kPerCount_m) * kPerCount_m;
    left_over_m_ = left_m - left;
    right_over_m_ = right_m - right;
    const double turned_rad = robot_.scale_turn * (right - left) / kBase_m, went_m = 0.5 * (left + right);
    T_odom_body_ =
        T_odom_body_ * Pose2{went_m * std::cos(0.5 * turned_rad), went_m * std::sin(0.5 * turned_rad), turned_rad};
  }

  BearingSet seen(Stamp stamp) {
    const double late_s = robot_.image_lag_s - kJitter_s * std::log(1.0 - numbers_.uniform());
    const auto ago = std::min(past_.size() - 1, static_cast<std::size_t>(std::lround(late_s / kTick_s)));
    const Pose2 T_world_camera = past_[ago] * Pose2{robot_.p_body_camera_m.x(), robot_.p_body_camera_m.y(), 0.0};
    BearingSet set;
    set.stamp = stamp;
    for (std::size_t i = 0; i < landmarks_.size(); ++i) {
      const Eigen::Vector2d p = inverse(T_world_camera) * landmarks_[i];
      const bool behind_wall = (landmarks_[i].x() > kWall_m) != (T_world_camera.x_m > kWall_m);
      if (behind_wall || p.norm() > kSeenWithin_m || p.norm() < 0.4 || numbers_.uniform() > kDetected) continue;
      const double error_rad = heavy_tailed(robot_.bearing_noise * kSigmaBearing_rad, numbers_);
      Bearing& bearing = set.bearings.emplace_back();
      bearing.azimuth_rad = wrap(std::atan2(p.y(), p.x()) - robot_.camera_yaw_rad + error_rad);
      if (robot_.names) bearing.identity = static_cast<Identity>(i);
    }
    return set;
  }

  EncoderRobot robot_;
  Numbers numbers_;
  std::vector<Eigen::Vector2d> landmarks_;
  Pose2 T_world_body_, T_odom_body_;
  std::deque<Pose2> past_;
  int tick_ = 0;
  Lasting speed_, turn_;
  double left_over_m_ = 0.0, right_over_m_ = 0.0;
};

}  // namespace

Run driven(const EncoderRobot& robot, std::vector<Stamp>* set_down) {
  Drive drive(robot);
  Run run = drive.run();
  if (set_down != nullptr) *set_down = drive.set_down;
  return run;
}

}  // namespace azimuth
