// Coloured landmarks (mathematics I.11).

#include "slam/perception/colour/blobs.hpp"
#include "slam/perception/colour/outline.hpp"
#include "tests/golden/checks.hpp"

namespace azimuth::golden {

void check_polar(const GoldenCase& golden) {
  const Eigen::Vector2d centre = to_vector(golden.input.at("center"));
  std::vector<CentredPoint> boundary = to_points(golden.input.at("boundary"));
  for (CentredPoint& point : boundary) point -= centre;
  expect_near(radial_line_rad(boundary), golden.expected.at("angle").get<double>(), golden.tolerance, "angle");
}

void check_compactness(const GoldenCase& golden) {
  const double area = golden.input.at("area"), perimeter = golden.input.at("perimeter");
  expect_near(compactness(area, perimeter), golden.expected.get<double>(), golden.tolerance, "compactness");
}

}  // namespace azimuth::golden
