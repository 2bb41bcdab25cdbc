// The filter does not allocate in its steady state, so that the time of a step does not depend on the allocator.

#include <gtest/gtest.h>
#include <memory>

#include "slam/ekf/bearing_ekf.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/printed_choices.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

TEST(AllocationCounter, SeesOperatorNewAndMalloc) {
  const std::size_t before = allocations();
  auto number = std::make_unique<int>(1);
  asm volatile("" : : "r"(number.get()) : "memory");  // keeps the compiler from removing the allocation
  EXPECT_EQ(allocations(), before + 1);
  const Eigen::MatrixXd matrix(10, 10);
  asm volatile("" : : "r"(matrix.data()) : "memory");
  EXPECT_EQ(allocations(), before + 2);
}

/// A filter with 24 rays all round, in the middle of a run.
class SteadyFilter {
 public:
  SteadyFilter(JointState::Retraction retraction, int iterations) : ekf_(settings_for(retraction, iterations)) {
    for (int i = 0; i < 24; ++i) rays_.push_back(ekf_.add_ray(azimuth_rad(i), 0.02, 0.25, 0.2));
  }

  /// One step with sightings of `count` landmarks.
  bool step(int count) {
    sightings_.clear();
    for (int i = 0; i < count; ++i) {
      const Index ray = rays_[static_cast<std::size_t>(i * 24 / count)];
      MappedSighting sighting{JointState::kPose, ray, BlockKind::inverse_depth, 0.0, 4e-4};
      const auto row = ekf_.linearise(sighting);
      if (!row) continue;
      sighting.azimuth_rad = wrap(0.01 - row->innovation);
      sightings_.push_back(sighting);
    }
    ekf_.predict(motion_);
    return ekf_.update(sightings_);
  }

  /// The cloning and removal that delayed initialisation does in every image.
  void clone_and_forget() { ekf_.remove(ekf_.clone_robot(), BlockKind::pose); }

  void reserve(int count) { sightings_.reserve(static_cast<std::size_t>(count)); }

 private:
  static BearingEkfSettings settings_for(JointState::Retraction retraction, int iterations) {
    BearingEkfSettings settings;
    settings.retraction = retraction;
    settings.max_iterations = iterations;
    settings.charge_curvature = true;
    settings.sigma_considered.setConstant(0.01);
    return settings;
  }
  static double azimuth_rad(int i) { return wrap(2.0 * kPi * i / 24.0); }

  BearingEkf ekf_;
  std::vector<Index> rays_;
  std::vector<MappedSighting> sightings_;
  Motion motion_{{0.02, 0.0, 0.01}, Eigen::Matrix3d::Identity() * 1e-6, 0.02, 0.01};
};

struct Configuration {
  JointState::Retraction retraction;
  int iterations;
};
std::ostream& operator<<(std::ostream& out, const Configuration& configuration) {
  return out << testing::PrintToString(configuration.retraction)
             << (configuration.iterations == 1 ? " plain" : " iterated");
}

class Allocation : public testing::TestWithParam<Configuration> {};

TEST_P(Allocation, NoneAfterTheLargestBatch) {
  SteadyFilter filter(GetParam().retraction, GetParam().iterations);
  filter.reserve(24);
  for (int warm_up = 0; warm_up < 3; ++warm_up) {
    filter.clone_and_forget();  // grows the state to its maximum before the last warm-up step
    ASSERT_TRUE(filter.step(24));
  }
  const std::size_t before = allocations();
  for (int step = 0; step < 50; ++step) {
    filter.step(1 + (step * 7) % 24);  // batches of all sizes
    filter.clone_and_forget();
  }
  EXPECT_EQ(allocations() - before, 0u);
}

INSTANTIATE_TEST_SUITE_P(Filters, Allocation,
                         testing::Values(Configuration{JointState::Retraction::additive, 1},
                                         Configuration{JointState::Retraction::invariant, 1},
                                         Configuration{JointState::Retraction::additive, 4},
                                         Configuration{JointState::Retraction::invariant, 4}),
                         test::PrintedName());

}  // namespace
}  // namespace azimuth
