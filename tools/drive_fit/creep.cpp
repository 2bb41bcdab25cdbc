#include "tools/drive_fit/creep.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/index.hpp"
#include "tools/drive_fit/drive_motions.hpp"

namespace azimuth {
namespace {

// Below these speeds of odometry the robot may be standing.
constexpr double kSlow_m_s = 0.05, kSlow_rad_s = 0.05;
constexpr double kLeastStanding_s = 3.0;
constexpr double kSettling_s = 0.7;  // margin at both ends of a stretch, since clocks may differ
constexpr double kMostChi2 = 9.0;    // upper limit for each squared normalised residual
constexpr double kStands = 3.0;      // least evidence for a stretch to count as standing

struct Stretch {
  std::size_t first = 0, end = 0;  // indices of bearing sets
};

double span_s(const Drive& drive, const Stretch& stretch) {
  return to_seconds(drive.sets[stretch.end - 1].stamp - drive.sets[stretch.first].stamp);
}

/// The stretch without kSettling_s at either end.
Stretch settled(const Drive& drive, Stretch stretch) {
  const Stamp from = drive.sets[stretch.first].stamp + duration_from_seconds(kSettling_s),
              to = drive.sets[stretch.end - 1].stamp - duration_from_seconds(kSettling_s);
  while (stretch.first < stretch.end && drive.sets[stretch.first].stamp < from) ++stretch.first;
  while (stretch.end > stretch.first && drive.sets[stretch.end - 1].stamp > to) --stretch.end;
  return stretch;
}

std::vector<Stretch> slow_stretches(const Drive& drive, const std::vector<Pose2>& poses) {
  std::vector<Stretch> stretches;
  const auto close = [&](std::size_t first, std::size_t end) {
    const Stretch stretch = end > first ? settled(drive, {first, end}) : Stretch{};
    if (stretch.end > stretch.first + 2 && span_s(drive, stretch) >= kLeastStanding_s) stretches.push_back(stretch);
  };
  std::size_t first = 0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Pose2 step = inverse(poses[i - 1]) * poses[i];
    const double took_s = std::max(1e-3, to_seconds(drive.sets[i].stamp - drive.sets[i - 1].stamp));
    if (step.position().norm() < kSlow_m_s * took_s && std::abs(step.heading_rad) < kSlow_rad_s * took_s) continue;
    close(first, i);
    first = i;
  }
  close(first, poses.size());
  return stretches;
}

std::map<Identity, SmoothedLandmark> landmarks_by_name(const DriveSolution& solution) {
  std::map<Identity, SmoothedLandmark> landmarks;
  for (const DriveGraph::Place& place : solution.graph.places)
    for (const DriveGraph::Seen& seen : place.seen)
      landmarks[seen.bearing.identity] = solution.graph.values.landmarks[as_size(seen.landmark)];
  return landmarks;
}

/// The pose at the first place of the solution that is not before `stamp`, or at the last place.
Pose2 pose_at(const DriveSolution& solution, Stamp stamp) {
  const auto& places = solution.graph.places;
  const auto after = std::ranges::lower_bound(places, stamp, {}, &DriveGraph::Place::stamp);
  const auto at = after == places.end() ? places.size() - 1 : static_cast<std::size_t>(after - places.begin());
  return solution.graph.values.poses[at].T_map_body;
}

/// Azimuth residuals of one landmark over a stretch, under the hypotheses that the robot stands and that it moves as
/// odometry says. The later subtraction of the mean removes constant errors.
struct SeenAgain {
  std::vector<double> standing_rad, going_rad, sigma_rad;
};

double centred_chi2(const std::vector<double>& off_rad, const std::vector<double>& sigma_rad) {
  double mean = 0.0, weights = 0.0;
  for (std::size_t i = 0; i < off_rad.size(); ++i) {
    const double weight = 1.0 / (sigma_rad[i] * sigma_rad[i]);
    mean += weight * off_rad[i];
    weights += weight;
  }
  mean /= weights;
  double chi2 = 0.0;
  for (std::size_t i = 0; i < off_rad.size(); ++i)
    chi2 += std::min(kMostChi2, std::pow((off_rad[i] - mean) / sigma_rad[i], 2));
  return chi2;
}

struct Judged {
  double standing = 0.0, going = 0.0;  // chi squared under each hypothesis
  double bearings = 0.0;
};

Judged judged(const Drive& drive, const Stretch& stretch, const std::vector<Pose2>& poses, const Pose2& T_map_start,
              const std::map<Identity, SmoothedLandmark>& landmarks, const RigGuess& guess) {
  std::map<Identity, SeenAgain> seen;
  std::map<Identity, double> first_rad;
  for (std::size_t i = stretch.first; i < stretch.end; ++i) {
    const SmoothedPose there(T_map_start * (inverse(poses[stretch.first]) * poses[i]));
    for (const Bearing& bearing : drive.sets[i].bearings) {
      const auto landmark = landmarks.find(bearing.identity);
      SeenAzimuth start, now;
      if (landmark == landmarks.end() || !see(SmoothedPose(T_map_start), landmark->second, 0.05, start) ||
          !see(there, landmark->second, 0.05, now))
        continue;
      const double azimuth_rad = robot_azimuth(bearing, guess);
      const double from_rad = first_rad.emplace(bearing.identity, azimuth_rad).first->second;
      const double standing_rad = wrap(azimuth_rad - from_rad);
      SeenAgain& each = seen[bearing.identity];
      each.standing_rad.push_back(standing_rad);
      each.going_rad.push_back(wrap(standing_rad - wrap(now.azimuth_rad - start.azimuth_rad)));
      each.sigma_rad.push_back(std::isnan(bearing.sigma_rad) ? guess.rig.camera.sigma_bearing_rad : bearing.sigma_rad);
    }
  }
  Judged sum;
  for (const auto& [name, each] : seen) {
    sum.standing += centred_chi2(each.standing_rad, each.sigma_rad);
    sum.going += centred_chi2(each.going_rad, each.sigma_rad);
    sum.bearings += static_cast<double>(each.sigma_rad.size());
  }
  return sum;
}

const double kToldBy = std::log(1e4);
// Least creep in a minute of standing that matters.
constexpr double kMinute_s = 60.0, kCrept_rad = 0.025, kCrept_m = 0.1;

}  // namespace

bool Creep::is_told() const {
  return evidence > kToldBy && (rad_per_s() * kMinute_s > kCrept_rad || m_per_s() * kMinute_s > kCrept_m);
}

OdometryRig with_floors_of(const OdometryRig& rig, const Creep& creep) {
  OdometryRig covered = rig;
  covered.floor_rotation_rad = std::max(rig.floor_rotation_rad, creep.rad_per_s());
  covered.floor_distance_m = std::max(rig.floor_distance_m, creep.m_per_s());
  return covered;
}

Creep creep_of(const Drive& drive, const DriveSolution& solution) {
  std::vector<Stamp> stamps;
  for (const BearingSet& set : drive.sets) stamps.push_back(set.stamp);
  const std::vector<Pose2> poses = camera_at(drive.odometry, solution.guess, stamps);
  const auto landmarks = landmarks_by_name(solution);
  Creep creep;
  for (const Stretch& stretch : slow_stretches(drive, poses)) {
    const Judged of =
        judged(drive, stretch, poses, pose_at(solution, stamps[stretch.first]), landmarks, solution.guess);
    if (of.bearings < 3.0) continue;
    creep.slow_s += span_s(drive, stretch);
    const double evidence = 0.5 * (of.going - of.standing) / std::max(1.0, of.standing / of.bearings);
    if (evidence < kStands) continue;
    creep.evidence += evidence;
    const Pose2 crept = inverse(poses[stretch.first]) * poses[stretch.end - 1];
    creep.standing_s += span_s(drive, stretch);
    creep.turned_rad += std::abs(crept.heading_rad);
    creep.driven_m += crept.position().norm();
    ++creep.stretches;
  }
  return creep;
}

}  // namespace azimuth
