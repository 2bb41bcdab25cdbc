// Eigen includes this file within its class MatrixBase (EIGEN_MATRIXBASE_PLUGIN), after the definition of the arm64
// instructions and before its kernels for products of large matrices. On arm64 these kernels would use fused
// multiply-adds and process six rows at a time instead of the four on x86, which changes the order of the sums.

#undef EIGEN_HAS_SINGLE_INSTRUCTION_MADD
// NOLINTBEGIN(cppcoreguidelines-macro-usage): names of functions that Eigen calls
#define vfmaq_n_f32(sum, a, b) vaddq_f32(sum, vmulq_n_f32(a, b))
#define vfmaq_n_f64(sum, a, b) vaddq_f64(sum, vmulq_n_f64(a, b))
#define vfmaq_laneq_f32(sum, a, b, lane) vaddq_f32(sum, vmulq_laneq_f32(a, b, lane))
#define vfmaq_laneq_f64(sum, a, b, lane) vaddq_f64(sum, vmulq_laneq_f64(a, b, lane))
// NOLINTEND(cppcoreguidelines-macro-usage)
