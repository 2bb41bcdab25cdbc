// Runs `azimuth map refine`, which smooths the whole run at once, independently of the configured estimator.

#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

#include "drivers/storage/map_file.hpp"
#include "tests/support/places.hpp"
#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

class RefineCommand : public testing::Test {
 protected:
  Json report_of(const std::vector<std::string>& arguments) {
    const std::string report = scratch_ / "report.json";
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {"--report", report, "--quiet"});
    const Outcome outcome = azimuth(all);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out + outcome.err, "");
    return Json::parse(file_bytes(report));
  }

  ScratchFolder scratch_;
};

TEST_F(RefineCommand, WritesTrajectoryMapReportAndPicture) {
  const std::string report = scratch_ / "report.json", plot = scratch_ / "map.svg", tum = scratch_ / "lab.tum",
                    map = scratch_ / "lab.azmap";
  const Outcome outcome = azimuth(
      {"map", "refine", test::shipped_run().string(), "--report", report, "--plot", plot, "--tum", tum, "--map", map});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out,
              HasSubstr("refined     everything at once; which bearing is of which landmark, its name says"));
  EXPECT_THAT(outcome.out, HasSubstr("hindsight   rmse"));

  const Json json = Json::parse(file_bytes(report));
  EXPECT_EQ(json["estimator"], "smoother");
  EXPECT_LT(json["hindsight"]["rmse_m"], 0.06);
  EXPECT_LT(json["hindsight"]["rmse_m"], 0.8 * json["pose"]["rmse_m"].get<double>());
  EXPECT_EQ(json["map"]["matched"], 24);
  EXPECT_LT(json["hindsight"]["map"]["rmse_m"], 0.03);

  std::istringstream lines(file_bytes(tum));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) ++count;
  EXPECT_EQ(count, json["steps"]);
  EXPECT_THAT(file_bytes(plot), HasSubstr("stroke:rgb(80%,47.5%,65.5%)")) << "the path in hindsight";
  EXPECT_EQ(read_map(map)->map.landmarks.size(), 24U);
}

TEST_F(RefineCommand, TheTrajectoryThatIsWrittenIsTheRefinedOne) {
  const std::string tum = scratch_ / "lab.tum", online = scratch_ / "online.tum";
  ASSERT_EQ(azimuth({"map", "refine", test::one_lap(), "--tum", tum, "--quiet"}).code, 0);
  ASSERT_EQ(azimuth({"replay", test::one_lap(), "--set", "estimator=smoother", "--tum", online, "--quiet"}).code, 0);
  EXPECT_NE(file_bytes(tum), file_bytes(online));
  const Outcome judged = azimuth({"report", "trajectory", tum, test::one_lap()});
  EXPECT_EQ(judged.code, 0) << judged.err;
}

TEST_F(RefineCommand, AFilterStartsFromTheRefinedMap) {
  const std::string map = scratch_ / "lab.azmap";
  ASSERT_EQ(azimuth({"map", "refine", test::one_lap(), "--map", map, "--quiet"}).code, 0);
  const Outcome again = azimuth({"replay", test::one_lap(), "--map", map, "--localise"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("tracking at the end"));
}

TEST_F(RefineCommand, AnotherEstimatorInTheConfigurationChangesNothing) {
  const Json plain = report_of({"map", "refine", test::one_lap()});
  for (const char* estimator : {"ekf", "smoother"}) {
    const Json other = report_of({"map", "refine", test::one_lap(), "--set", std::string("estimator=") + estimator});
    EXPECT_EQ(other["digest"], plain["digest"]) << estimator;
    EXPECT_EQ(other["hindsight"], plain["hindsight"]) << estimator;
  }
}

TEST_F(RefineCommand, LandmarksThatAreAllAlikeArePathAndMapsToDecide) {
  const std::string run = scratch_ / "run";
  ASSERT_EQ(azimuth({"simulate", run, "--world", "lab", "--laps", "1"}).code, 0);
  const Outcome outcome = azimuth({"map", "refine", run, "--no-names", "--set", "smoother.members=2"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("is what explains all of them best"));
}

TEST_F(RefineCommand, LandmarksThatHaveLooksAreTheFiltersToDecide) {
  const std::string run = scratch_ / "run", map = scratch_ / "run.azmap";
  ASSERT_EQ(azimuth({"simulate", run, "--world", "coloured-lab"}).code, 0);
  const Outcome outcome = azimuth({"map", "refine", run, "--map", map});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("refined     everything at once; which bearing is of which landmark"));
  EXPECT_TRUE(std::filesystem::exists(map));
}

TEST_F(RefineCommand, FilesThatCannotBeWrittenAreFoundBeforeTheRun) {
  const Outcome outcome = azimuth({"map", "refine", test::one_lap(), "--map", scratch_ / "none" + "/lab.azmap"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.out, "");
}

}  // namespace
}  // namespace azimuth::test
