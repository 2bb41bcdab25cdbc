#include "tools/azimuth/lens_words.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>

#include "slam/geometry/angle.hpp"

namespace azimuth {

void print_lens(const Lens& lens, const LensCovariance& covariance, double seen_to_rad, bool scale_known) {
  const auto sigma = [&](int number) { return std::sqrt(covariance(number, number)); };
  fmt::print("centre      camera.centre_px = ({:.2f}, {:.2f}) +- ({:.2f}, {:.2f})\n", lens.axes.centre_px.x(),
             lens.axes.centre_px.y(), sigma(0), sigma(1));
  const auto a = lens.coefficients();
  constexpr std::array<int, 4> kOrders{0, 2, 3, 4};
  for (int k = 0; k < 4; ++k) {
    const int order = kOrders[as_size(k)];
    if (k == 0 && !scale_known) {
      fmt::print("lens        camera.polynomial_a0 = {:.4f} as the lens began: see height\n", a[0]);
      continue;
    }
    fmt::print("lens        camera.polynomial_a{} = {:.4g} +- {:.2g}\n", order, a[as_size(order)],
               sigma(2 + k) * std::pow(lens.radius_px, 1 - order));
  }
  fmt::print("lens        camera.polynomial_a1 = 0: held, since a smooth lens has none\n");
  for (const double degrees : {15.0, 30.0, 45.0, 60.0, 75.0, 90.0})
    if (const double theta_rad = degrees_to_rad(degrees); theta_rad <= seen_to_rad)
      fmt::print("radius      {:.2f} +- {:.2f} px at {:.0f} degrees from the axis\n", radius_px(lens, theta_rad),
                 sigma_radius_px(lens, covariance, theta_rad), degrees);
}

}  // namespace azimuth
