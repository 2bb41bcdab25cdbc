#include "tools/drive_fit/drive_picture.hpp"

#include <fmt/format.h>
#include <utility>
#include <vector>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/index.hpp"
#include "slam/smoother/factors.hpp"
#include "tools/drive_fit/drive_motions.hpp"

namespace azimuth {
namespace {

/// Dead reckoning as a line that starts at the first pose of the fitted path.
PlotLine odometry_line(const Drive& drive, const DriveGraph& graph, const OdometryRig& rig) {
  std::vector<Stamp> stamps;
  for (const DriveGraph::Place& place : graph.places) stamps.push_back(place.stamp);
  const std::vector<Pose2> poses = odometry_at(drive.odometry, rig, stamps);
  const Pose2 T_map_odom = graph.values.poses.front().T_map_body * inverse(poses.front());
  PlotLine line;
  for (const Pose2& pose : poses) line.push_back(T_map_odom * pose.position());
  return line;
}

/// Adds all landmarks with a known position, each with the identity of its bearings.
void add_landmarks(const DriveGraph& graph, const Smoother& smoother, MapPicture& picture) {
  std::vector<Identity> names(graph.values.landmarks.size(), kUnknownIdentity);
  for (const DriveGraph::Place& place : graph.places)
    for (const DriveGraph::Seen& seen : place.seen) names[as_size(seen.landmark)] = seen.bearing.identity;
  for (LandmarkId id = 0; id < smoother.graph().landmarks(); ++id) {
    if (!smoother.graph().landmark(id).is_point()) continue;
    picture.landmarks.push_back({.point = {smoother.graph().landmark(id).p_map(), smoother.point_covariance(id)},
                                 .name = fmt::format("{}", names[as_size(id)])});
  }
}

}  // namespace

MapPicture drive_picture(const Drive& drive, const DriveSolution& solution, const Rig& said,
                         const HindsightSettings& settings, std::string title, std::string subtitle) {
  MapPicture picture;
  picture.title = std::move(title);
  picture.subtitle = std::move(subtitle);
  const Smoother smoother = smoother_of(drive, solution.graph, solution.guess, {}, settings);
  PathPiece& path = picture.estimate.emplace_back();
  for (PoseId id = 0; id < smoother.graph().poses(); ++id) path.line.push_back(smoother.graph().pose(id).position());
  picture.odometry = odometry_line(drive, solution.graph, said.odometry);
  picture.calibrated = odometry_line(drive, solution.graph, solution.guess.rig.odometry);
  add_landmarks(solution.graph, smoother, picture);
  picture.T_map_body = smoother.newest_pose();
  return picture;
}

std::vector<PlottedResidual> residuals_with(const Drive& drive, const DriveGraph& graph, const RigGuess& guess,
                                            const HindsightSettings& settings) {
  const Smoother smoother = smoother_of(drive, graph, guess, {}, settings);
  const BearingGraph& solved = smoother.graph();
  std::vector<PlottedResidual> residuals;
  for (BearingId id = 0; id < solved.bearings(); ++id) {
    const LandmarkId landmark = solved.landmark_of(id);
    if (landmark == kOfNothing || solved.bearings_of(landmark).size() < 3) continue;
    const BearingMeasurement& measured = solved.bearing(id);
    SeenAzimuth expected;
    if (!see(solved.smoothed_pose(measured.pose), solved.landmark(landmark), SmootherSettings{}.min_distance_m,
             expected))
      continue;
    residuals.push_back({measured.azimuth_rad, wrap(measured.azimuth_rad - expected.azimuth_rad) / measured.sigma_rad});
  }
  return residuals;
}

}  // namespace azimuth
