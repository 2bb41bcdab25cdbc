#pragma once
#include <Eigen/Core>
#include <array>
#include <span>

namespace azimuth {

using Index = Eigen::Index;

/// One row of a measurement Jacobian: coefficients on at most five blocks, zero elsewhere.
struct ObservationRow {
  struct Part {
    Index offset = 0;
    Index size = 0;
    std::array<double, 5> coefficients{};

    Index end() const { return offset + size; }
  };
  std::array<Part, 5> parts{};
  int count = 0;
  double innovation = 0.0;
  double variance = 0.0;

  void add(Index offset, std::span<const double> coefficients);
};

/// The two axes of one measured direction.
using RowPair = std::array<ObservationRow, 2>;

}  // namespace azimuth
