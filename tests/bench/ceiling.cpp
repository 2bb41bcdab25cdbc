#include "tests/bench/ceiling.hpp"

namespace azimuth::bench {
namespace {

constexpr double kBetweenColumns_m = 9.0, kBetweenRows_m = 4.5;

}  // namespace

std::vector<Eigen::Vector2d> ceiling_lamps(int count, int rows) {
  std::vector<Eigen::Vector2d> lamps;
  const int columns = count / rows;
  for (int i = 0; i < count; ++i) {
    const int column = i % columns, row = i / columns;
    lamps.emplace_back(kBetweenColumns_m * (column - 0.5 * (columns - 1)) + 1.3,
                       kBetweenRows_m * (row - 0.5 * (rows - 1)) + 0.7);
  }
  return lamps;
}

double hall_reach_m(int count, int rows) {
  const int columns = count / rows;
  return 0.5 * kBetweenColumns_m * columns;
}

}  // namespace azimuth::bench
