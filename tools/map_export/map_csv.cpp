#include "tools/map_export/map_csv.hpp"

#include <fmt/format.h>

#include "tools/map_export/own_covariance.hpp"

namespace azimuth {
namespace {

std::string known(std::int64_t value) { return value < 0 ? "" : fmt::format("{}", value); }

}  // namespace

std::string map_csv(const MapSnapshot& map) {
  std::string csv =
      "landmark_id,x_m,y_m,z_m,kind,identity,sightings,var_x_m2,var_y_m2,var_z_m2,cov_xy_m2,cov_xz_m2,cov_yz_m2\n";
  for_each_landmark(map, [&csv](const MapLandmark& landmark, const Eigen::Matrix3d& P) {
    const bool high = landmark.has_height();
    const auto of_height = [high](double value) { return high ? fmt::format("{}", value) : std::string(); };
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", landmark.id, landmark.p_map_landmark_m.x(),
                       landmark.p_map_landmark_m.y(), of_height(landmark.z_map_landmark_m), known(landmark.kind),
                       known(landmark.identity), landmark.sightings, P(0, 0), P(1, 1), of_height(P(2, 2)), P(1, 0),
                       of_height(P(2, 0)), of_height(P(2, 1)));
  });
  return csv;
}

}  // namespace azimuth
