#pragma once
#include <Eigen/Core>

namespace azimuth {

/// A symmetric matrix of which only the lower triangle counts: column j holds rows j to size-1; columns are `stride`
/// doubles apart. Elements above the diagonal are scratch, and so is the rest of the storage, which has room for
/// padded(size) rows and columns.
struct LowerTriangle {
  double* data;
  Eigen::Index size;
  Eigen::Index stride;

  static constexpr Eigen::Index kTile = 16;  ///< Largest number of rows or columns written at once
  static constexpr Eigen::Index padded(Eigen::Index size) { return (size + kTile - 1) / kTile * kTile; }
};

/// The sum of w w^T over the first `squares` columns w of W, and of u v^T + v u^T over the `pairs` of columns (u, v)
/// after them. W is column-major with columns `stride` doubles apart, and must be readable up to padded(size) rows of
/// the matrix it is subtracted from. Without columns W may be null.
struct SymmetricProduct {
  const double* W;
  Eigen::Index stride;
  Eigen::Index squares, pairs;
};

/// A -= product, on the lower triangle.
///
/// Every element is summed in the order of the columns. The result is the same to the last bit on every processor of
/// the same kind; one with fused multiply-add rounds differently from one without. Does not allocate.
void subtract_symmetric_product(LowerTriangle A, SymmetricProduct product);

/// W <- W L^-T for a lower triangular L with a positive diagonal: decorrelates the columns of P H^T. W is size x
/// `columns`, laid out as above, and may be written up to padded(size) rows. L is columns x columns, column-major.
///
/// Rounding and allocation as for subtract_symmetric_product().
void whiten_columns(double* W, Eigen::Index stride, Eigen::Index size, const double* L, Eigen::Index L_stride,
                    Eigen::Index columns);

// The kernels for processors with AVX2 and FMA.
namespace avx2 {
void subtract_symmetric_product(LowerTriangle A, SymmetricProduct product);
void whiten_columns(double* W, Eigen::Index stride, Eigen::Index size, const double* L, Eigen::Index L_stride,
                    Eigen::Index columns);
}  // namespace avx2

// The kernels for processors with AVX-512F.
namespace avx512 {
void subtract_symmetric_product(LowerTriangle A, SymmetricProduct product);
void whiten_columns(double* W, Eigen::Index stride, Eigen::Index size, const double* L, Eigen::Index L_stride,
                    Eigen::Index columns);
}  // namespace avx512

}  // namespace azimuth
