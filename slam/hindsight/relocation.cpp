#include "slam/hindsight/relocation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "slam/ekf/resection.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kFewest = 5;          // bearings; any three fit some pose
constexpr std::size_t kContradictions = 3;  // fewer contradictions speak against landmarks rather than the pose
constexpr int kUnknowns = 3;
// Upper bound of a chi-square with as many degrees of freedom as there are bearings beyond the unknowns: the mean plus
// three standard deviations.
double gate(std::size_t bearings) {
  const double freedom = static_cast<double>(bearings) - kUnknowns;
  return freedom + 3.0 * std::sqrt(2.0 * freedom);
}
constexpr double kRivalFactor = 2.0;       // a rival pose must exceed the gate by this factor
constexpr double kContradictsChi2 = 30.0;  // 3 degrees of freedom; beyond it, two poses contradict each other

bool counts(const UsedBearing& bearing, std::int64_t known_below) {
  return bearing.established && bearing.landmark_id < known_below;
}

bool is_contradicted(std::span<const UsedBearing> heard, std::int64_t known_below) {
  std::size_t established = 0, misfits = 0;
  for (const UsedBearing& bearing : heard) {
    if (!counts(bearing, known_below)) continue;
    ++established;
    misfits += bearing.agrees ? 0 : 1;
  }
  return established >= kFewest && misfits >= kContradictions && 2 * misfits > established;
}

std::optional<Resection> resection(const Mapper& mapper, std::int64_t known_below, double min_distance_m,
                                   std::size_t& bearings) {
  const Smoother& smoother = mapper.smoother();
  std::vector<DirectionTo> directions;
  std::vector<Smoother::Unknown> unknowns;
  double variance_rad2 = 0.0;
  for (const UsedBearing& bearing : mapper.heard()) {
    if (!counts(bearing, known_below)) continue;
    const auto of = std::ranges::find(mapper.landmarks(), bearing.landmark_id, &HindsightLandmark::id);
    if (of == mapper.landmarks().end() || !smoother.graph().landmark(of->in_graph).is_point()) continue;
    directions.push_back({smoother.graph().landmark(of->in_graph).p_map(),
                          wrap(bearing.azimuth_rad + smoother.graph().calibration()[calibration::yaw])});
    unknowns.emplace_back(Smoother::LandmarkOf{of->in_graph});
    variance_rad2 = std::max(variance_rad2, bearing.sigma_rad * bearing.sigma_rad);
  }
  bearings = directions.size();
  if (bearings < kFewest) return std::nullopt;
  const Eigen::MatrixXd in_chart = smoother.covariance(unknowns);
  Eigen::MatrixXd to_map = Eigen::MatrixXd::Zero(in_chart.rows(), in_chart.cols());
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    to_map.block<2, 2>(2 * as_index(i), 2 * as_index(i)) =
        smoother.graph().landmark(std::get<Smoother::LandmarkOf>(unknowns[i]).id).p_by_chart();
  return resect(directions, to_map * in_chart * to_map.transpose(), variance_rad2, min_distance_m);
}

}  // namespace

std::optional<PoseGaussian> relocated(const Mapper& mapper, const PoseGaussian& belief, std::int64_t known_below,
                                      double min_distance_m) {
  if (!is_contradicted(mapper.heard(), known_below)) return std::nullopt;
  std::size_t bearings = 0;
  const std::optional<Resection> found = resection(mapper, known_below, min_distance_m, bearings);
  if (!found || found->chi2 > gate(bearings) || found->rival_chi2 < kRivalFactor * gate(bearings)) return std::nullopt;
  const Pose2 T_map_body = mapper.smoother().graph().body_at(found->T_map_body);
  Eigen::Vector3d apart = T_map_body.vector() - belief.T_map_body.vector();
  apart.z() = wrap(apart.z());
  const Eigen::Matrix3d P = belief.covariance + found->covariance;
  if (apart.dot(P.ldlt().solve(apart)) < kContradictsChi2) return std::nullopt;
  return PoseGaussian{T_map_body, found->covariance};
}

}  // namespace azimuth
