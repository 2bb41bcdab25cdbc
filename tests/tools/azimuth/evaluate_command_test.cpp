#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/places.hpp"
#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

using Json = nlohmann::json;

TEST(EvaluateCommand, AgreesWithTheReplayThatWroteTheTrajectory) {
  const ScratchFolder scratch;
  const std::string tum = scratch / "lab.tum", replayed = scratch / "replay.json", judged = scratch / "evaluate.json";
  ASSERT_EQ(azimuth({"replay", test::one_lap(), "--tum", tum, "--report", replayed}).code, 0);
  const Outcome outcome = azimuth({"report", "trajectory", tum, test::one_lap(), "--report", judged});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json from_replay = Json::parse(file_bytes(replayed))["pose"], json = Json::parse(file_bytes(judged));
  for (const char* key : {"rmse_m", "mean_m", "max_m", "final_m", "heading_rmse_rad", "heading_max_rad"})
    EXPECT_NEAR(json["pose"][key].get<double>(), from_replay[key].get<double>(), 1e-9) << key;
  EXPECT_TRUE(json["pose"]["anees"].is_null());
  EXPECT_TRUE(json["pose"]["two_sigma_final"][0].is_null());
  EXPECT_TRUE(json["odometry_only"]["rmse_m"].is_null());
}

struct BadTrajectory {
  std::string name, text, complaint;
};
std::ostream& operator<<(std::ostream& out, const BadTrajectory& bad) { return out << bad.name; }

class BadTrajectories : public testing::TestWithParam<BadTrajectory> {};

TEST_P(BadTrajectories, AreRefusedByLine) {
  const ScratchFolder scratch;
  const std::string tum = scratch / "bad.tum";
  write_file(tum, GetParam().text);
  const Outcome outcome = azimuth({"report", "trajectory", tum, test::one_lap()});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find(GetParam().complaint), std::string::npos) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(
    All, BadTrajectories,
    testing::Values(BadTrajectory{"words", "# t x y\n1 2 3 4 0 0 0 one\n", "bad.tum:2: expected eight numbers"},
                    BadTrajectory{"too_few", "1 2 3 4 0 0 0\n", "bad.tum:1: expected eight numbers"},
                    BadTrajectory{"too_many", "1 2 3 4 0 0 0 1 5\n", "bad.tum:1: expected eight numbers"},
                    BadTrajectory{"not_finite", "1 nan 3 4 0 0 0 1\n", "bad.tum:1: expected eight numbers"},
                    BadTrajectory{"quaternion", "1 2 3 4 0 0 0 0\n", "bad.tum:1: quaternion"},
                    BadTrajectory{"order", "2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", "bad.tum:2: stamp"},
                    BadTrajectory{"huge", "1e300 0 0 0 0 0 0 1\n", "bad.tum:1: stamp"},
                    BadTrajectory{"empty", "# nothing\n", "bad.tum: holds no pose"},
                    BadTrajectory{"elsewhen", "1e6 0 0 0 0 0 0 1\n", "no stamp lies within"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace azimuth::test
