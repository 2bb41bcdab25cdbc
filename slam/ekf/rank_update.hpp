#pragma once
#include <Eigen/Core>

namespace azimuth {

/// A symmetric matrix of which only the lower triangle is stored: column j holds rows j to size-1, `stride` doubles
/// from one column to the next.
struct LowerTriangle {
  double* data;
  Eigen::Index size;
  Eigen::Index stride;
};

/// A -= W Z^T on the lower triangle, for a product that is symmetric (Z = W, or pairs of columns u, v in W that stand
/// as v, u in Z). W and Z are size x `columns`, column-major, `stride` doubles from one column to the next.
///
/// Every element is summed in the order of the columns. The result is the same to the last bit on every processor of
/// the same kind; one with fused multiply-add rounds differently from one without. Does not allocate.
void subtract_symmetric_product(LowerTriangle A, const double* W, const double* Z, Eigen::Index stride,
                                Eigen::Index columns);

}  // namespace azimuth
