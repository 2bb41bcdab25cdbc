
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "settings/configured_estimator.hpp"
#include "slam/hindsight/with_hindsight.hpp"

namespace azimuth {
namespace {

using testing::HasSubstr;

Rig rig_with(FrontEnd front_end, bool identities) {
  Rig rig;
  rig.front_end = front_end;
  rig.camera.identities = identities;
  return rig;
}

TEST(RefiningEstimator, NamesLooksAndNeitherAreDecidedByThoseWhoCan) {
  Configuration configuration;
  EXPECT_EQ(refined_by(rig_with(FrontEnd::bearings, true), configuration), RefinedBy::names);
  EXPECT_EQ(refined_by(rig_with(FrontEnd::bearings, false), configuration), RefinedBy::hypotheses);
  for (const FrontEnd looks : {FrontEnd::colour, FrontEnd::sift, FrontEnd::lamps})
    EXPECT_EQ(refined_by(rig_with(looks, false), configuration), RefinedBy::filter);
  configuration.smoother.names = false;
  EXPECT_EQ(refined_by(rig_with(FrontEnd::bearings, true), configuration), RefinedBy::hypotheses);
}

TEST(RefiningEstimator, WhichEstimatorIsConfiguredDoesNotMatter) {
  for (const auto& [configured, kind] : estimator_kinds()) {
    Configuration configuration;
    configuration.estimator = kind;
    EXPECT_EQ(chosen_refining_estimator(rig_with(FrontEnd::bearings, true), configuration), EstimatorKind::smoother)
        << configured;
    EXPECT_EQ(chosen_refining_estimator(rig_with(FrontEnd::bearings, false), configuration), EstimatorKind::smoother)
        << configured;
    EXPECT_EQ(chosen_refining_estimator(rig_with(FrontEnd::sift, false), configuration), EstimatorKind::ekf)
        << configured;
    EXPECT_EQ(chosen_refining_estimator(rig_with(FrontEnd::lamps, false), configuration), EstimatorKind::lamp_ekf)
        << configured;
  }
}

TEST(RefiningEstimator, SaysWhatIsNotRefined) {
  const Configuration configuration;
  EXPECT_THAT(how_refined(rig_with(FrontEnd::lamps, false), configuration), HasSubstr("the path at once"));
  EXPECT_THAT(how_refined(rig_with(FrontEnd::lamps, false), configuration),
              HasSubstr("the map, estimator \"lamp_ekf\""));
  EXPECT_THAT(how_refined(rig_with(FrontEnd::colour, false), configuration), HasSubstr("everything at once"));
}

TEST(RefiningEstimator, TheSmootherLeavesToAFilterWhatIsNotForIt) {
  Configuration configuration;
  configuration.estimator = EstimatorKind::smoother;
  Rig rig;
  rig.front_end = FrontEnd::sift;
  std::vector<PastPose> past;
  const std::unique_ptr<Estimator> estimator = configured_estimator(rig, configuration);
  EXPECT_TRUE(estimator->write_past(past));
  EXPECT_NE(dynamic_cast<const WithHindsight*>(estimator.get()), nullptr);
}

TEST(RefiningEstimator, AlwaysHasAPast) {
  for (const FrontEnd front_end : {FrontEnd::bearings, FrontEnd::colour, FrontEnd::sift}) {
    const Rig rig = rig_with(front_end, front_end == FrontEnd::bearings);
    std::vector<PastPose> past;
    EXPECT_TRUE(refining_estimator(rig, {})->write_past(past));
  }
}

TEST(RefiningEstimator, AMapOfLooksIsNotStartedFrom) {
  MapSnapshot map;
  map.names = MapNames::sensor;
  EXPECT_TRUE(why_unfit_to_refine(map, rig_with(FrontEnd::sift, false), {}));
  Configuration localising;
  localising.map.mode = MapMode::localise;
  EXPECT_FALSE(why_unfit_to_refine(map, rig_with(FrontEnd::bearings, true), localising)) << "it is made better";
}

}  // namespace
}  // namespace azimuth
