// Eigen includes this within its class MatrixBase (EIGEN_MATRIXBASE_PLUGIN), when it knows arm64's instructions and has
// not yet made its products of large matrices of them. Those round once for a product and its sum, and take six rows of
// a matrix at a time where x86 takes four, by which sums come about in another order.

#undef EIGEN_HAS_SINGLE_INSTRUCTION_MADD
// NOLINTBEGIN(cppcoreguidelines-macro-usage): names of functions that Eigen calls
#define vfmaq_n_f32(sum, a, b) vaddq_f32(sum, vmulq_n_f32(a, b))
#define vfmaq_n_f64(sum, a, b) vaddq_f64(sum, vmulq_n_f64(a, b))
#define vfmaq_laneq_f32(sum, a, b, lane) vaddq_f32(sum, vmulq_laneq_f32(a, b, lane))
#define vfmaq_laneq_f64(sum, a, b, lane) vaddq_f64(sum, vmulq_laneq_f64(a, b, lane))
// NOLINTEND(cppcoreguidelines-macro-usage)
