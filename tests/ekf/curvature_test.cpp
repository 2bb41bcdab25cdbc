// The nonlinear part of a bearing that a linear update neglects, compared with its variance over many draws.

#include "slam/ekf/curvature.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

#include "slam/camera/camera_model.hpp"
#include "slam/ekf/bearing_ekf.hpp"
#include "slam/ekf/lamp_ekf.hpp"
#include "tests/geometry/numeric_jacobian.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

constexpr int kManyDraws = 20000;

/// The variance of f(x) - f(mean) - J (x - mean) over draws of x around the mean.
double left_out(const std::function<double(const Eigen::VectorXd&)>& f, const Eigen::VectorXd& mean,
                const Eigen::MatrixXd& covariance, RandomDraws& draws) {
  const auto as_vector = [&](const Eigen::VectorXd& x) { return Eigen::VectorXd::Constant(1, f(x)); };
  const Eigen::MatrixXd J = numeric_jacobian(as_vector, mean, {}, 1e-4);
  const Eigen::MatrixXd L = covariance.llt().matrixL();
  const double at_mean = f(mean);
  double sum = 0.0, sum2 = 0.0;
  for (int i = 0; i < kManyDraws; ++i) {
    const Eigen::VectorXd dx = L * draws.normals(mean.size());
    const double rest = f(mean + dx) - at_mean - (J * dx)(0);
    sum += rest;
    sum2 += rest * rest;
  }
  return sum2 / kManyDraws - std::pow(sum / kManyDraws, 2);
}

/// A filter that has seen one landmark from an uncertain pose.
struct SeenOnce {
  BearingEkf ekf;
  Index ray;

  explicit SeenOnce(RandomDraws& draws, bool charge = true, double sigma_centre_px = 0.0)
      : ekf([&] {
          BearingEkfSettings settings;
          settings.charge_curvature = charge;
          settings.sigma_centre_px = sigma_centre_px;
          return settings;
        }()) {
    ekf.inflate_robot(draws.covariance(3, 0.05));
    ray = ekf.add_ray(draws.uniform(-kPi, kPi), 0.01, 0.3, 0.05, sigma_centre_px > 0.0 ? 150.0 : BearingEkf::kNoRadius);
    ekf.inflate_robot(draws.covariance(3, 0.1));
  }

  Eigen::MatrixXd covariance(std::vector<Index> entries) const {
    Eigen::MatrixXd P(entries.size(), entries.size());
    ekf.state().covariance(entries, entries, P);
    return P;
  }
};

TEST(Curvature, OfARayIsWhatItsRowLeavesOut) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    RandomDraws draws(seed);
    const SeenOnce seen(draws);
    const Index f = seen.ray;
    const std::vector<Index> entries{0, 1, 2, f, f + 1, f + 2, f + 3};
    Eigen::VectorXd mean(7);
    for (std::size_t i = 0; i < entries.size(); ++i) mean(static_cast<Index>(i)) = seen.ekf.state().mean(entries[i]);
    const double here_rad = predict_bearing(Pose2{}, seen.ekf.ray(f), 0.0)->azimuth_rad;
    const auto azimuth = [&](const Eigen::VectorXd& x) {
      const InverseDepth ray{x.segment<2>(3), x(5), x(6)};
      return wrap(predict_bearing({x(0), x(1), x(2)}, ray, 0.0)->azimuth_rad - here_rad);
    };
    const double expected = left_out(azimuth, mean, seen.covariance(entries), draws);
    const double charged = seen.ekf.curvature_rad2({.landmark = f, .kind = BlockKind::inverse_depth});
    EXPECT_GT(charged, 0.4 * expected) << seed;
    EXPECT_LT(charged, 2.5 * expected) << seed;
  }
}

TEST(Curvature, OfAPointIsWhatItsRowLeavesOut) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    RandomDraws draws(seed);
    SeenOnce seen(draws);
    const Index f = seen.ray;
    seen.ekf.promote(f);
    const std::vector<Index> entries{0, 1, 2, f, f + 1};
    Eigen::VectorXd mean(5);
    for (std::size_t i = 0; i < entries.size(); ++i) mean(static_cast<Index>(i)) = seen.ekf.state().mean(entries[i]);
    const auto azimuth_of = [](const Eigen::VectorXd& x) {
      return predict_bearing({x(0), x(1), x(2)}, Eigen::Vector2d(x.tail<2>()), 0.0)->azimuth_rad;
    };
    const double here_rad = azimuth_of(mean);
    const auto azimuth = [&](const Eigen::VectorXd& x) { return wrap(azimuth_of(x) - here_rad); };
    const double expected = left_out(azimuth, mean, seen.covariance(entries), draws);
    const double charged = seen.ekf.curvature_rad2({.landmark = f, .kind = BlockKind::point});
    EXPECT_GT(charged, 0.6 * expected) << seed;
    EXPECT_LT(charged, 1.6 * expected) << seed;
  }
}

TEST(Curvature, OfAKnockedCameraIsWhatItsRowLeavesOut) {
  RandomDraws draws(3);
  constexpr double kSigma_px = 10.0, kRadius_px = 150.0;
  const Eigen::Matrix2d covariance_px2 = kSigma_px * kSigma_px * Eigen::Matrix2d::Identity();
  for (const double azimuth_rad : {-2.0, 0.0, 1.0, 3.0}) {
    const Eigen::Vector2d p_px = kRadius_px * Eigen::Vector2d(std::cos(azimuth_rad), std::sin(azimuth_rad));
    const auto azimuth = [&](const Eigen::VectorXd& e) {
      return wrap(std::atan2(p_px.y() - e.y(), p_px.x() - e.x()) - azimuth_rad);
    };
    const double expected = left_out(azimuth, Eigen::Vector2d::Zero(), covariance_px2, draws);
    EXPECT_NEAR(curvature_by_centre_rad2(p_px, covariance_px2, 2.0), expected, 0.1 * expected);
  }
}

TEST(Curvature, IsChargedOnlyWhereTheSettingsSay) {
  RandomDraws draws(4);
  const SeenOnce seen(draws, false, 10.0);
  EXPECT_EQ(seen.ekf.curvature_rad2({.landmark = seen.ray, .kind = BlockKind::inverse_depth, .radius_px = 150.0}), 0.0);
}

/// The curvature variance vanishes for small uncertainties, so a filter with a certain pose loses no information.
TEST(Curvature, FallsWithTheFourthPowerOfWhatIsUnknown) {
  BearingEkfSettings settings;
  settings.charge_curvature = true;
  double last = 0.0;
  for (const double sigma_m : {0.1, 0.01}) {
    BearingEkf ekf(settings);
    const Index f = ekf.add_ray(0.3, 1e-4, 0.25, 0.1 * sigma_m);
    ekf.inflate_robot(sigma_m * sigma_m * Eigen::Matrix3d::Identity());
    const double charged = ekf.curvature_rad2({.landmark = f, .kind = BlockKind::inverse_depth});
    if (last > 0.0) {
      EXPECT_NEAR(charged / last, 1e-4, 2e-5);
    }
    last = charged;
  }
}

/// The curvature of a lens, for directions to lamps, in both axes of the tangent plane.
TEST(Curvature, OfTheLensIsWhatTheJacobianLeavesOut) {
  RandomDraws draws(5);
  constexpr double kFocal_px = 250.0, kSigma_px = 8.0;
  for (const double zenith_rad : {0.1, 0.6, 1.0, 1.3}) {
    // An equidistant lens images the zenith angle t at the radius f t.
    const auto ray_of = [&](const Eigen::Vector2d& p_px) {
      const double r = p_px.norm(), t = r / kFocal_px;
      return Eigen::Vector3d(std::sin(t) * p_px.x() / r, std::sin(t) * p_px.y() / r, std::cos(t));
    };
    const double azimuth_rad = draws.uniform(-kPi, kPi), r = kFocal_px * zenith_rad;
    const Eigen::Vector2d radial(std::cos(azimuth_rad), std::sin(azimuth_rad)), sideways(-radial.y(), radial.x());
    const Eigen::Vector3d across(sideways.x(), sideways.y(), 0.0);
    const Eigen::Vector3d outwards(std::cos(zenith_rad) * radial.x(), std::cos(zenith_rad) * radial.y(),
                                   -std::sin(zenith_rad));
    LampSeen seen{TangentDirection(azimuth_rad, zenith_rad, {1e-6, 1e-6})};
    seen.by_camera.leftCols<2>() << -std::sin(zenith_rad) / r * sideways.transpose(), radial.transpose() / kFocal_px;
    const Eigen::Matrix2d P = kSigma_px * kSigma_px * Eigen::Matrix2d::Identity();
    Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
    covariance.topLeftCorner<2, 2>() = P;
    const Eigen::Vector2d charged = lens_curvature(seen, covariance);
    for (const int axis : {0, 1}) {
      const Eigen::Vector3d towards = ray_of(r * radial), along = axis == 0 ? across : outwards;
      const auto place = [&](const Eigen::VectorXd& e) {
        const Eigen::Vector3d moved = ray_of(r * radial - Eigen::Vector2d(e));
        return along.dot(moved) / towards.dot(moved);
      };
      const double expected = left_out(place, Eigen::Vector2d::Zero(), P, draws);
      // The tolerance covers the nonlinearity of the projection into the tangent plane itself, which is small.
      EXPECT_LT(std::abs(std::sqrt(charged(axis)) - std::sqrt(expected)), 0.3 * std::sqrt(expected) + 2e-4)
          << zenith_rad << " axis " << axis;
    }
  }
}

}  // namespace
}  // namespace azimuth
