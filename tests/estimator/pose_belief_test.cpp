#include "slam/estimator/pose_belief.hpp"

#include <gtest/gtest.h>

#include "tests/geometry/numeric_jacobian.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

TEST(PoseBelief, OfTheBodyFollowsTheRigByItsDerivatives) {
  RandomDraws draws(1);
  for (int i = 0; i < 100; ++i) {
    PoseBelief belief{.T_map_body = draws.pose(3.0), .covariance = Eigen::Matrix3d::Zero()};
    belief.velocity = draws.normals(3);
    const auto body = [&](const Eigen::VectorXd& errors) {
      PoseBelief other = belief;
      other.believed = errors;
      return Eigen::VectorXd(other.body().vector());
    };
    EXPECT_LT(largest_difference(belief.by_considered_of_body(), numeric_jacobian(body, Considered::Zero(), {2})),
              kJacobianTolerance);
  }
}

}  // namespace
}  // namespace azimuth
