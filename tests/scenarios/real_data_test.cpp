// Position accuracy that must be reached on recorded runs that are not shipped.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <ostream>

#include "tests/scenarios/replayed.hpp"
#include "tests/support/data.hpp"

namespace azimuth {
namespace {

Run load(const std::string& name) {
  auto run = load_run(test::data_folder() / name);
  EXPECT_TRUE(run) << text(run.error());
  return run ? *std::move(run) : Run{};
}

void print_row(const std::string& name, const Report& report) {
  fmt::print(
      "{:<24} rmse {:6.3f} m  max {:6.3f} m  odometry {:6.3f} m  landmarks {:2d}/{:2d}, {:.3f} m  ANEES {:.2f}\n", name,
      report.position_m.rmse, report.position_m.max, report.odometry_m.rmse, report.map.matched,
      report.map.true_landmarks, report.map.position_m.mean, report.consistency.anees);
}

struct Limit {
  const char* run;
  double rmse_m;
};
std::ostream& operator<<(std::ostream& out, const Limit& limit) { return out << limit.run; }

class Mrclam : public testing::TestWithParam<Limit> {
 protected:
  void SetUp() override { AZIMUTH_REQUIRE_DATA(GetParam().run); }
};

TEST_P(Mrclam, WithNames) {
  // GIVEN a real robot that reads barcodes with a narrow field of view
  const auto run = load(GetParam().run);
  // WHEN its run is replayed with the default settings
  const Report report = replayed(run);
  print_row(std::string(GetParam().run) + ", names", report);
  // THEN the pose error is small, and all landmarks are mapped once
  EXPECT_LE(report.position_m.rmse, GetParam().rmse_m);
  EXPECT_EQ(report.named_map.named, 15u);
  EXPECT_EQ(report.named_map.duplicates, 0u);
}

TEST_P(Mrclam, WithoutNames) {
  // GIVEN the same robot without its barcode readings
  const auto run = load(GetParam().run);
  Rig rig = rig_of(run);
  rig.camera.identities = false;
  // WHEN the estimator has to associate bearings by gates and joint compatibility
  const Report report = replayed(run, rig);
  print_row(std::string(GetParam().run) + ", no names", report);
  // THEN the estimate beats calibrated odometry
  EXPECT_LT(report.position_m.rmse, report.odometry_m.rmse);
}

INSTANTIATE_TEST_SUITE_P(Runs, Mrclam,
                         testing::Values(Limit{"mrclam6-robot1", 1.09}, Limit{"mrclam6-robot2", 0.30},
                                         Limit{"mrclam6-robot3", 0.30}),
                         [](const auto& instance) {
                           return "Robot" + std::string(1, std::string(instance.param.run).back());
                         });

TEST(LabRuns, DefaultSettings) {
  AZIMUTH_REQUIRE_DATA("lab-runs");
  // GIVEN twenty runs from another author's simulator
  const Runs runs =
      replay_seeds(20, [](std::uint64_t seed) { return replayed(load(fmt::format("lab-runs/lab-{:03}", seed - 1))); });
  runs.print("lab-runs");
  // THEN no run diverges, and the covariances are consistent
  EXPECT_LE(runs.mean_m(), 0.15);
  EXPECT_LE(runs.worst_m(), kDiverged_m);
  EXPECT_GE(runs.anees(), 1.5);
  EXPECT_LE(runs.anees(), 4.0);
}

TEST(LabRuns, PaperPresetIsInconsistent) {
  AZIMUTH_REQUIRE_DATA("lab-runs");
  const Runs runs = replay_seeds(20, [](std::uint64_t seed) {
    const auto run = load(fmt::format("lab-runs/lab-{:03}", seed - 1));
    return replayed(run, paper_preset());
  });
  runs.print("lab-runs, paper");
  EXPECT_GT(runs.anees(), 10.0);
  EXPECT_GT(runs.mean_m(), 0.15);
}

TEST(Course, SidewaysSlipIsModelled) {
  AZIMUTH_REQUIRE_DATA("course-301");
  const Report report = replayed(load("course-301"));
  print_row("course-301", report);
  EXPECT_LE(report.position_m.rmse, 0.20);
}

}  // namespace
}  // namespace azimuth
