#include "tools/drive_fit/spread.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kJackknifeParts = 10;

}  // namespace

std::vector<std::size_t> ends_of_parts(const DriveGraph& graph) {
  const std::size_t all = graph.bearings();
  std::vector<std::size_t> ends;
  std::size_t counted = 0;
  for (std::size_t i = 0; i < graph.places.size(); ++i) {
    counted += graph.places[i].seen.size();
    if (counted * kJackknifeParts >= (ends.size() + 1) * all) ends.push_back(i + 1);
  }
  return ends;
}

namespace {

/// Difference of two sets of numbers, with angles wrapped.
Calibration difference(const Calibration& a, const Calibration& b) {
  Calibration off = a - b;
  off[calibration::yaw] = wrap(off[calibration::yaw]);
  return off;
}

}  // namespace

Eigen::Matrix<double, kCalibrations, kCalibrations> spread_of(const Drive& drive, const DriveSolution& solution,
                                                              const FreeErrors& free,
                                                              const HindsightSettings& settings) {
  const Calibration all = numbers_of(solution.guess);
  std::vector<Calibration> off;
  Calibration mean = Calibration::Zero();
  std::size_t first = 0;
  for (const std::size_t end : ends_of_parts(solution.graph)) {
    const DriveSolution rest =
        solved(drive, without(solution.graph, std::exchange(first, end), end), solution.guess, free, settings);
    off.push_back(difference(numbers_of(rest.guess), all));
    mean += off.back();
  }
  const auto parts = static_cast<double>(off.size());
  mean /= parts;
  Calibration variance = Calibration::Zero();
  for (const Calibration& each : off) variance += (each - mean).cwiseAbs2() * (parts - 1.0) / parts;
  // Each number gets the larger variance; correlations are those of the graph.
  Calibration grown = Calibration::Ones();
  for (Eigen::Index i = 0; i < kCalibrations; ++i)
    if (const double own = solution.covariance(i, i); own > 0.0) grown[i] = std::sqrt(std::max(1.0, variance[i] / own));
  return grown.asDiagonal() * solution.covariance * grown.asDiagonal();
}

}  // namespace azimuth
