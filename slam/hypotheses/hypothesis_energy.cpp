// What a hypothesis costs (SPEC VI.20).

#include <algorithm>

#include "slam/hypotheses/hypothesis.hpp"

namespace azimuth {

double Hypothesis::energy() const {
  double energy = motion_energy();
  for (BearingId id = 0; id < graph().bearings(); ++id)
    energy += is_unassigned(id) ? settings_.costs.unassigned
                                : std::min(0.5 * graph().chi2_of(id), settings_.costs.unassigned);
  energy += settings_.costs.landmark * static_cast<double>(landmarks_.size());
  int missed_in_all = 0;
  for (const LandmarkId id : landmarks_) missed_in_all += missed(id);
  return energy + member_.missed_scale * settings_.costs.missed * missed_in_all;
}

double Hypothesis::motion_energy() const {
  double energy = 0.0;
  SmoothedPose start(graph().pose(0));
  for (PoseId id = 1; id < graph().poses(); ++id) {
    const SmoothedPose end(graph().pose(id));
    const OdometryMeasurement& measured = graph().odometry_to(id);
    Eigen::Vector3d off = relative_pose(start, end) - measured.relative -
                          measured.by_calibration * graph().calibration().head<kOdometryCalibrations>();
    off.z() = wrap(off.z());
    energy += 0.5 * (measured.whitening * off).squaredNorm();
    start = end;
  }
  return energy;
}

/// Images between its first and its last bearing in which it should have been seen and was not.
int Hypothesis::missed(LandmarkId id) const {
  const SmoothedLandmark& landmark = graph().landmark(id);
  if (!landmark.is_point()) return 0;
  std::vector<PoseId> seen_from;
  for (const BearingId bearing : graph().bearings_of(id)) seen_from.push_back(graph().bearing(bearing).pose);
  std::sort(seen_from.begin(), seen_from.end());
  const Eigen::Vector2d p = landmark.p_map();
  const double range_m = settings_.scene.surely_seen_within_m();
  int missed = 0;
  auto next = seen_from.begin();
  for (PoseId pose = seen_from.front(); pose < seen_from.back(); ++pose) {
    if (pose == *next) {
      while (*next == pose) ++next;
      continue;
    }
    const Pose2& T = graph().pose(pose);
    const Eigen::Vector2d away = p - T.position();
    if (away.squaredNorm() > range_m * range_m) continue;
    if (settings_.scene.sees_all_round() || settings_.scene.in_view(std::atan2(away.y(), away.x()) - T.heading_rad))
      ++missed;
  }
  return missed;
}

}  // namespace azimuth
