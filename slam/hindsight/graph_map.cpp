#include "slam/hindsight/graph_map.hpp"

#include <Eigen/Core>
#include <vector>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

/// Covariance of the camera entries of the saved map.
Eigen::MatrixXd camera_covariance(const MapSnapshot& map) {
  const Eigen::Index size = as_index(map.camera.size());
  Eigen::MatrixXd P(size, size);
  for (Eigen::Index c = 0; c < size; ++c)
    for (Eigen::Index r = 0; r < size; ++r)
      P(r, c) = map.covariance(MapSnapshot::kPoseEntries + as_size(r), MapSnapshot::kPoseEntries + as_size(c));
  return P;
}

/// Index of an entry of pose or landmarks in a covariance that has the camera's entries between pose and landmarks.
Eigen::Index behind_camera(Eigen::Index entry, Eigen::Index camera) { return entry < 3 ? entry : entry + camera; }

}  // namespace

bool place_by_graph(const Mapper& mapper, std::span<const LandmarkId> in_graph, MapSnapshot& out) {
  const BearingGraph& graph = mapper.smoother().graph();
  std::vector<Smoother::Unknown> unknowns{Smoother::PoseOf{graph.poses() - 1}};
  for (const LandmarkId landmark : in_graph) unknowns.emplace_back(Smoother::LandmarkOf{landmark});
  const Eigen::MatrixXd in_chart = mapper.smoother().covariance(unknowns);
  if (in_chart.rows() != 3 + 2 * as_index(in_graph.size())) return false;  // the only pose is the first one, a constant
  const MovedPose moved = apply(graph.pose(graph.poses() - 1), mapper.since_anchor());
  Eigen::MatrixXd to_points = Eigen::MatrixXd::Identity(in_chart.rows(), in_chart.cols());
  to_points.topLeftCorner<3, 3>() = moved.G;
  for (std::size_t i = 0; i < in_graph.size(); ++i) {
    const SmoothedLandmark& landmark = graph.landmark(in_graph[i]);
    to_points.block<2, 2>(3 + 2 * as_index(i), 3 + 2 * as_index(i)) = landmark.p_by_chart();
    out.landmarks[i].p_map_landmark_m = landmark.p_map();
  }
  Eigen::MatrixXd P = to_points * in_chart * to_points.transpose();
  P.topLeftCorner<3, 3>() += moved.noise;
  out.T_map_body = moved.T_map_body;
  const Eigen::MatrixXd of_camera = camera_covariance(out);
  const Eigen::Index camera = of_camera.rows();
  out.covariance.resize(as_size(P.rows() + camera));
  for (Eigen::Index c = 0; c < P.cols(); ++c)
    for (Eigen::Index r = c; r < P.rows(); ++r)
      out.covariance(as_size(behind_camera(r, camera)), as_size(behind_camera(c, camera))) = P(r, c);
  for (Eigen::Index c = 0; c < camera; ++c)
    for (Eigen::Index r = c; r < camera; ++r) out.covariance(as_size(3 + r), as_size(3 + c)) = of_camera(r, c);
  return true;
}

}  // namespace azimuth
