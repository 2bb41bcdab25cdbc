#pragma once
#include <Eigen/Core>
#include <vector>

namespace azimuth {

/// The quantile of the standard normal distribution; `probability` strictly between 0 and 1. Relative error below
/// 1e-14.
double normal_quantile(double probability);

/// Element `index` (from 1) of the van der Corput sequence in `base`: a number strictly between 0 and 1.
double van_der_corput(int index, int base);

/// Halton points 1 to `count` in bases 2, 3, 5, 7, 11, 13, 17, 19, mapped to independent standard normals: the fixed
/// sample set of the quality test (mathematics I.9).
std::vector<Eigen::Matrix<double, 8, 1>> halton_normal_8d(int count);

}  // namespace azimuth
