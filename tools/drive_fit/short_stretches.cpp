#include "tools/drive_fit/short_stretches.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "slam/geometry/angle.hpp"
#include "tools/drive_fit/drive_motions.hpp"

namespace azimuth {
namespace {

// Length and turn at which a stretch ends: long enough for rays to near landmarks to intersect, short enough for
// odometry to be accurate.
constexpr double kStretch_m = 4.0, kStretch_rad = kPi;
constexpr std::size_t kLeastRays = 3;
// Approximate combined error of odometry and bearings on a stretch.
constexpr double kSigma_rad = 0.1;
constexpr double kTie = 1e-3;  // weight per ray that pulls landmarks with nearly parallel rays to the robot's position

constexpr double kYawStep_rad = kPi / 24.0;
constexpr double kTurnFrom = 0.6, kTurnTo = 1.6, kTurnStep = 0.05;
constexpr double kLagMost_s = 0.6, kLagStep_s = 0.1;
constexpr int kRounds = 2;

bool same_odometry(const OdometryRig& a, const OdometryRig& b) {
  return a.scale_distance == b.scale_distance && a.scale_turn == b.scale_turn &&
         a.drift_rad_per_m == b.drift_rad_per_m && a.lag_s == b.lag_s && a.clock_drift == b.clock_drift &&
         a.wheels_swapped == b.wheels_swapped;
}

bool same_motions(const RigGuess& a, const RigGuess& b) {
  return same_odometry(a.rig.odometry, b.rig.odometry) && mount_of(a.rig) == mount_of(b.rig) && a.jump == b.jump;
}

}  // namespace

ShortStretches::ShortStretches(const Drive& drive, const Rig& rig) : drive_(drive) {
  for (const BearingSet& set : drive.sets) stamps_.push_back(set.stamp);
  const std::vector<Pose2> poses = odometry_at(drive.odometry, rig.odometry, stamps_);
  double driven_m = 0.0, turned_rad = 0.0;
  std::size_t first = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    driven_m += (poses[i].position() - poses[i - 1].position()).norm();
    turned_rad += std::abs(wrap(poses[i].heading_rad - poses[i - 1].heading_rad));
    if (driven_m < kStretch_m && turned_rad < kStretch_rad && i + 1 < poses.size()) continue;
    find_landmarks(first, i + 1);
    first = i;
    driven_m = turned_rad = 0.0;
  }
}

void ShortStretches::find_landmarks(std::size_t first, std::size_t end) {
  starts_.push_back(drive_.sets[first].stamp);
  std::map<Identity, Landmark> seen;
  for (std::size_t set = first; set < end; ++set)
    for (std::size_t i = 0; i < drive_.sets[set].bearings.size(); ++i)
      if (const Identity name = drive_.sets[set].bearings[i].identity; name != kUnknownIdentity)
        seen[name].push_back({set, i});
  for (auto& [name, rays] : seen) {
    if (rays.size() < kLeastRays) continue;
    judged_ += rays.size();
    landmarks_.push_back(std::move(rays));
    stretch_of_.push_back(starts_.size() - 1);
  }
}

double ShortStretches::cost(const RigGuess& guess) {
  if (judged_ == 0) return kMostCost;
  pose_for(guess);
  double sum = 0.0;
  for (const Landmark& landmark : landmarks_) sum += cost_of(landmark, guess, poses_);
  return sum / static_cast<double>(judged_);
}

void ShortStretches::pose_for(const RigGuess& guess) {
  if (posed_for_ && same_motions(*posed_for_, guess)) return;
  poses_ = camera_at(drive_.odometry, guess, stamps_);
  posed_for_ = guess;
}

std::vector<double> ShortStretches::costs(const RigGuess& guess) {
  pose_for(guess);
  std::vector<double> sums(starts_.size());
  for (std::size_t i = 0; i < landmarks_.size(); ++i) sums[stretch_of_[i]] += cost_of(landmarks_[i], guess, poses_);
  return sums;
}

/// With n perpendicular to a ray from p, the landmark l minimises the sum of (n . (l - p))^2.
double ShortStretches::cost_of(const Landmark& landmark, const RigGuess& guess, const std::vector<Pose2>& poses) {
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  const auto course_of = [&](const Ray& ray) {
    return poses[ray.set].heading_rad + robot_azimuth(drive_.sets[ray.set].bearings[ray.bearing], guess);
  };
  for (const Ray& ray : landmark) {
    const double course_rad = course_of(ray);
    const Eigen::Vector2d n(-std::sin(course_rad), std::cos(course_rad));
    const Eigen::Matrix2d across = n * n.transpose() + kTie * Eigen::Matrix2d::Identity();
    A += across;
    b += across * poses[ray.set].position();
  }
  const Eigen::Vector2d p = A.inverse() * b;
  double cost = 0.0;
  for (const Ray& ray : landmark) {
    const Eigen::Vector2d to = p - poses[ray.set].position();
    const double off = wrap(std::atan2(to.y(), to.x()) - course_of(ray)) / kSigma_rad;
    cost += std::min(0.5 * off * off, kMostCost);
  }
  return cost;
}

namespace {

/// The guess of least cost among those that `changed` makes from the numbers from `from` to `to`, and `guess` itself.
template <class Changed>
RigGuess best_of(ShortStretches& stretches, const RigGuess& guess, double from, double to, double step,
                 const Changed& changed) {
  RigGuess best = guess;
  double least = stretches.cost(guess);
  for (int i = 0; from + i * step <= to; ++i) {
    const RigGuess other = changed(guess, from + i * step);
    if (const double cost = stretches.cost(other); cost < least) {
      least = cost;
      best = other;
    }
  }
  return best;
}

RigGuess refined(ShortStretches& stretches, RigGuess guess, const RoughSearch& search) {
  const Rig said = guess.rig;
  for (int round = 0; round < kRounds; ++round) {
    if (search.yaw)
      guess =
          best_of(stretches, guess, -kPi, kPi - 0.5 * kYawStep_rad, kYawStep_rad, [](RigGuess other, double yaw_rad) {
            other.rig.camera.yaw_offset_rad = yaw_rad;
            return other;
          });
    if (search.turn)
      guess = best_of(stretches, guess, kTurnFrom, kTurnTo, kTurnStep, [&said](RigGuess other, double share) {
        other.rig.odometry.scale_turn = share * said.odometry.scale_turn;
        return other;
      });
    if (search.lag)
      guess = best_of(stretches, guess, -kLagMost_s, kLagMost_s, kLagStep_s, [&said](RigGuess other, double lag_s) {
        other.rig.odometry.lag_s = said.odometry.lag_s + lag_s;
        return other;
      });
  }
  return guess;
}

}  // namespace

std::vector<RigGuess> rough_guesses(ShortStretches& stretches, const RigGuess& guess, const RoughSearch& search) {
  std::vector<RigGuess> guesses{refined(stretches, guess, search)};
  if (!search.hand) return guesses;
  RigGuess other = guess;
  other.mirrored = !guess.mirrored;
  guesses.push_back(refined(stretches, other, search));
  std::ranges::stable_sort(guesses, {}, [&](const RigGuess& each) { return stretches.cost(each); });
  return guesses;
}

}  // namespace azimuth
