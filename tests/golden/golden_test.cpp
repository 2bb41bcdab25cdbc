// Every case of golden.json is one test. A case of an unknown kind fails, so that no new reference value is overlooked.

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

#include "tests/golden/checks.hpp"

namespace azimuth::golden {
namespace {

struct Check {
  std::string_view kind;
  void (*run)(const GoldenCase&);
};

constexpr std::array kChecks{
    Check{"wrap", check_wrap},
    Check{"control", check_control},
    Check{"motion", check_motion},
    Check{"const", check_const},
    Check{"clone", check_clone},
    Check{"bearing", check_bearing},
    Check{"ekf_update", check_ekf_update},
    Check{"intersect", check_intersect},
    Check{"intersect_reject", check_intersect_reject},
    Check{"halton", check_halton},
    Check{"kl", check_kl},
    Check{"ekf_run", check_ekf_run},
    Check{"ratio", check_ratio},
    Check{"view_interval", check_view_interval},
    Check{"pattern", check_pattern},
    Check{"hungarian", check_hungarian},
    Check{"h3", check_h3},
    Check{"fs_likelihood", check_fs_likelihood},
    Check{"assoc", check_assoc},
    Check{"alg3", check_alg3},
    Check{"alg4", check_alg4},
    Check{"joint_weight", check_joint_weight},
    Check{"counter", check_counter},
    Check{"crosspoint", check_crosspoint},
    Check{"cand_init", check_cand_init},
    Check{"resample", check_resample},
    Check{"align", check_align},
    Check{"pairdist", check_pairdist},
    Check{"polar", check_polar},
    Check{"compactness", check_compactness},
    Check{"camera", check_camera},
};

class Golden : public testing::TestWithParam<GoldenCase> {};

TEST_P(Golden, Agrees) {
  const GoldenCase& golden = GetParam();
  const auto* check = std::ranges::find(kChecks, std::string_view(golden.kind), &Check::kind);
  ASSERT_NE(check, kChecks.end()) << "unknown kind of golden case: " << golden.kind;
  check->run(golden);
}

std::string name_of(const testing::TestParamInfo<GoldenCase>& info) {
  std::string name = info.param.kind + "_" + info.param.name;
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Spec, Golden, testing::ValuesIn(golden_cases()), name_of);
// An unreadable file gives no cases; GoldenFile.IsComplete reports it.
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Golden);

TEST(GoldenFile, IsComplete) { EXPECT_EQ(golden_cases().size(), 60u) << AZIMUTH_GOLDEN_FILE; }

TEST(GoldenFile, HasACaseForEveryCheck) {
  for (const Check& check : kChecks)
    EXPECT_NE(std::ranges::find(golden_cases(), check.kind, &GoldenCase::kind), golden_cases().end()) << check.kind;
}

}  // namespace
}  // namespace azimuth::golden
