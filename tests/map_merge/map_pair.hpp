#pragma once
// Two maps of one hall as two drives might leave them, drawn from their own Gaussian distributions.

#include <Eigen/Cholesky>
#include <span>
#include <vector>

#include "slam/geometry/index.hpp"
#include "slam/sample/map_snapshot.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth::test {

struct TrueLandmark3 {
  Eigen::Vector3d p_world_m;
  Identity identity = kUnknownIdentity;
};

struct DrawnMap {
  MapSnapshot map;
  Eigen::VectorXd error;  ///< Error of every entry of its covariance
};

/// A map in the frame T_world_map. The landmarks are correlated with each other, and share the error of the frame.
inline DrawnMap drawn_map(std::span<const TrueLandmark3> landmarks, const Pose2& T_world_map, RandomDraws& draws,
                          bool heights = true, double sigma_m = 0.04) {
  DrawnMap drawn;
  MapSnapshot& map = drawn.map;
  map.T_map_body = draws.pose(3.0);
  map.camera = {draws.normal(), draws.normal()};
  map.names = landmarks.front().identity == kUnknownIdentity ? MapNames::none : MapNames::sensor;
  for (const TrueLandmark3& landmark : landmarks) {
    MapLandmark& mapped = map.landmarks.emplace_back();
    mapped.id = map.next_id++;
    mapped.identity = landmark.identity;
    mapped.p_map_landmark_m = inverse(T_world_map) * Eigen::Vector2d(landmark.p_world_m.head<2>());
    if (heights) mapped.z_map_landmark_m = landmark.p_world_m.z();
  }
  const Eigen::Index size = as_index(map.entries());
  Eigen::MatrixXd by_frame = Eigen::MatrixXd::Zero(size, 3);  // derivative by a small motion of the whole map
  for (Eigen::Index row = as_index(map.first_landmark_entry()), i = 0; i < as_index(map.landmarks.size()); ++i) {
    const Eigen::Vector2d p = map.landmarks[as_size(i)].p_map_landmark_m;
    by_frame.block<2, 3>(row, 0) << 1.0, 0.0, -p.y(), 0.0, 1.0, p.x();
    row += as_index(map.landmarks[as_size(i)].size());
  }
  const Eigen::Vector3d frame_sigma(0.02, 0.02, 0.003);
  const Eigen::MatrixXd P =
      draws.covariance(size, sigma_m) + by_frame * frame_sigma.cwiseAbs2().asDiagonal() * by_frame.transpose();
  map.covariance.resize(map.entries());
  for (std::size_t c = 0; c < map.entries(); ++c)
    for (std::size_t r = c; r < map.entries(); ++r) map.covariance(r, c) = P(as_index(r), as_index(c));
  drawn.error = P.llt().matrixL() * draws.normals(size);
  map.T_map_body.x_m += drawn.error(0);
  map.T_map_body.y_m += drawn.error(1);
  map.T_map_body.heading_rad = wrap(map.T_map_body.heading_rad + drawn.error(2));
  Eigen::Index row = as_index(map.first_landmark_entry());
  for (MapLandmark& landmark : map.landmarks) {
    landmark.p_map_landmark_m += drawn.error.segment<2>(row);
    if (landmark.has_height()) landmark.z_map_landmark_m += drawn.error(row + 2);
    row += as_index(landmark.size());
  }
  return drawn;
}

/// Lamps of a hall of 60 by 20 m, each displaced randomly by up to 1.5 m from a regular grid.
inline std::vector<TrueLandmark3> drawn_hall(RandomDraws& draws, bool names = false) {
  std::vector<TrueLandmark3> lamps;
  for (double x = 3.0; x < 60.0; x += 6.0)
    for (double y = 2.0; y < 20.0; y += 5.0)
      lamps.push_back({{x + draws.uniform(-1.5, 1.5), y + draws.uniform(-1.5, 1.5), 6.5},
                       names ? static_cast<Identity>(100 + lamps.size()) : kUnknownIdentity});
  return lamps;
}

inline std::vector<TrueLandmark3> between(std::span<const TrueLandmark3> lamps, double from_m, double to_m) {
  std::vector<TrueLandmark3> chosen;
  for (const TrueLandmark3& lamp : lamps)
    if (lamp.p_world_m.x() >= from_m && lamp.p_world_m.x() <= to_m) chosen.push_back(lamp);
  return chosen;
}

}  // namespace azimuth::test
