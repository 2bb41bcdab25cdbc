#include "tools/replay_page/step_log.hpp"

#include <gtest/gtest.h>

namespace azimuth {
namespace {

/// An estimator that expects the given bearings.
class Expecting final : public Estimator {
 public:
  std::vector<ExpectedBearing> expected;

  void predict(const Motion&) override {}
  void update(const BearingSet&) override {}
  void estimate(Estimate&) const override {}
  void look_ahead(const Motion&, Estimate&) const override {}
  void expect(std::vector<ExpectedBearing>& out) const override { out = expected; }
};

ExpectedBearing expected(std::int64_t landmark, double azimuth_rad, double sigma_rad) {
  return {.landmark = landmark, .azimuth_rad = azimuth_rad, .gate_rad = 3.0 * sigma_rad, .sigma_rad = sigma_rad};
}

AcceptedSighting accepted(std::int64_t landmark, double azimuth_rad) {
  return {.landmark_id = landmark, .azimuth_rad = azimuth_rad, .sigma_rad = 0.01};
}

TEST(StepLog, SquaresInnovationsByTheirDeviations) {
  Expecting estimator;
  estimator.expected = {expected(5, 3.1, 0.1), expected(2, 0.5, 0.02), expected(9, 1.0, kPi)};
  estimator.expected.back().sigma_rad = std::numeric_limits<double>::quiet_NaN();
  StepLog log;
  log.before_update({.stamp = {}, .sequence = 0, .bearings = std::vector<Bearing>(7)}, estimator);
  Estimate estimate;
  // Landmark 2 is off by one standard deviation and landmark 5 by two, across pi. Landmark 9 has no known deviation.
  // Landmark 4 is new.
  estimate.accepted = {accepted(2, 0.52), accepted(5, wrap(3.3)), accepted(9, 1.1), accepted(4, 2.0)};
  estimate.association.accepted = 4;
  log.after_step(estimate);
  ASSERT_EQ(log.steps().size(), 1u);
  EXPECT_EQ(log.steps()[0].seen, 7u);
  EXPECT_EQ(log.steps()[0].compared, 2u);
  EXPECT_NEAR(log.steps()[0].nis, 1.0 + 4.0, 1e-9);
  EXPECT_EQ(log.steps()[0].counts.accepted, 4u);
}

TEST(StepLog, WithoutAnUpdateNothingIsCompared) {
  Expecting estimator;
  estimator.expected = {expected(2, 0.5, 0.02)};
  StepLog log;
  Estimate estimate;
  estimate.accepted = {accepted(2, 0.52)};
  log.before_update({}, estimator);
  log.after_step(estimate);
  log.after_step(estimate);
  EXPECT_EQ(log.steps()[0].compared, 1u);
  EXPECT_EQ(log.steps()[1].compared, 0u);
  EXPECT_EQ(log.steps()[1].nis, 0.0);
}

}  // namespace
}  // namespace azimuth
