#pragma once
#include <Eigen/Core>
#include <span>

namespace azimuth {

/// Adjacent columns of a matrix with a factor for each. `first` points at the row where the sum starts; the columns are
/// `stride` doubles apart.
struct ScaledColumns {
  const double* first;
  Eigen::Index stride;
  const double* factors;
  Eigen::Index count;
};

/// out += A_1 f_1 + A_2 f_2 + ... on `size` rows, in one pass, since memory access dominates. For each element the
/// columns of a part are summed from first to last, then the parts in their order. Every product is rounded before it
/// is added, so the result is the same to the last bit on every processor.
void add_columns(std::span<const ScaledColumns> parts, Eigen::Index size, double* out);

// The kernel for processors with AVX2.
namespace avx2 {
void add_columns(const ScaledColumns* parts, Eigen::Index count, Eigen::Index size, double* out);
}

}  // namespace azimuth
