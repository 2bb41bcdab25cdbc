// Tests `azimuth check` on real robots whose rigs contain mistakes that other measurements confirm.

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <ostream>

#include "tests/support/data.hpp"
#include "tests/support/drive_of.hpp"
#include "tests/tools/check/spoilings.hpp"

namespace azimuth {
namespace {

struct RealRig {
  const char* run;
  std::vector<Mistake> wrong;
};
std::ostream& operator<<(std::ostream& out, const RealRig& rig) { return out << rig.run; }

class RealRigs : public testing::TestWithParam<RealRig> {};

TEST_P(RealRigs, AreToldWhatIsWrongWithThem) {
  AZIMUTH_REQUIRE_DATA(GetParam().run);
  const auto run = load_run(test::data_folder() / GetParam().run);
  ASSERT_TRUE(run) << text(run.error());
  const Rig rig = test::rig_of_run(*run);
  const Plausibility found = judge(test::drive_of(*run, rig), *run, rig, {});
  fmt::print("{}\n{}", GetParam().run, test::said(found));
  for (const MistakeVerdict& verdict : found.verdicts) {
    const bool is_wrong = std::ranges::find(GetParam().wrong, verdict.mistake) != GetParam().wrong.end();
    EXPECT_EQ(verdict.says == MistakeVerdict::Says::wrong, is_wrong) << to_string(verdict.mistake);
  }
}

INSTANTIATE_TEST_SUITE_P(Real, RealRigs,
                         testing::Values(RealRig{"lostwoods-c", {Mistake::heading}},
                                         RealRig{"mrclam9-robot3", {Mistake::turn, Mistake::lag, Mistake::distance}},
                                         RealRig{"dlr-circles-a", {Mistake::distance}}),
                         [](const auto& use) {
                           std::string name = use.param.run;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace azimuth
