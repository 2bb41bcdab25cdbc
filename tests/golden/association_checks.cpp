#include <cmath>
#include <gtest/gtest.h>
#include <map>

#include "slam/association/descriptor_store.hpp"
#include "slam/association/feature_patterns.hpp"
#include "slam/association/view_interval.hpp"
#include "slam/geometry/angle.hpp"
#include "tests/golden/checks.hpp"

namespace azimuth::golden {
namespace {

using nlohmann::json;

/// The golden distances are decimal fractions. In units of 1e-4 their squares are integers, as NearestTwo requires.
NearestTwo nearest_two(const json& distances, std::map<std::string, Identity>& identities, bool by_landmark) {
  NearestTwo two;
  for (const json& entry : distances) {
    const auto distance = static_cast<std::int32_t>(std::lround(entry.at(0).get<double>() * 1e4));
    const auto label = entry.at(1).get<std::string>();
    const Identity landmark = identities.try_emplace(label, static_cast<Identity>(identities.size())).first->second;
    const Identity identity = by_landmark ? landmark : static_cast<Identity>(&entry - &distances.front());
    two.add({distance * distance, identity, 0});
  }
  return two;
}

}  // namespace

void check_ratio(const GoldenCase& golden) {
  const json& distances = golden.input.at("query_dist");
  const double threshold = golden.input.at("thr");
  std::map<std::string, Identity> identities;
  const NearestTwo two = nearest_two(distances, identities, /*by_landmark=*/true);
  EXPECT_EQ(two.nearest.identity, identities.at(golden.expected.at("nearest")));
  expect_near(two.ratio(), golden.expected.at("ratio_other_id"), golden.tolerance, "ratio");
  EXPECT_EQ(two.ratio() <= threshold, golden.expected.at("match").get<bool>());
  // The ratio test as printed in the paper counts another view of the same landmark as a rival.
  const NearestTwo literal = nearest_two(distances, identities, /*by_landmark=*/false);
  expect_near(literal.ratio(), golden.expected.at("ratio_literal"), golden.tolerance, "literal ratio");
  EXPECT_EQ(literal.ratio() <= threshold, golden.expected.at("match_literal").get<bool>());
}

void check_view_interval(const GoldenCase& golden) {
  const auto interval = view_interval(to_vector(golden.input.at("p1")), golden.input.at("bearing_abs"),
                                      to_vector(golden.input.at("p2")), golden.input.at("R"));
  ASSERT_EQ(interval.has_value(), !golden.expected.is_null());
  if (!interval) return;
  expect_near(wrap(interval->start_rad - golden.expected.at("start").get<double>()), 0.0, golden.tolerance, "start");
  expect_near(interval->sweep_rad, golden.expected.at("sweep"), golden.tolerance, "sweep");
}

void check_pattern(const GoldenCase& golden) {
  const auto first = golden.input.at("A").get<std::vector<std::vector<double>>>();
  const auto second = golden.input.at("B").get<std::vector<std::vector<double>>>();
  for (std::size_t a = 0; a < first.size(); ++a)
    for (std::size_t b = 0; b < second.size(); ++b)
      expect_near(correlation(first[a], second[b]), golden.expected.at("corr").at(a).at(b), golden.tolerance,
                  "correlation");
  const std::size_t count = matched_members(first, second, golden.input.at("t_cc"));
  EXPECT_EQ(count, golden.expected.at("count").get<std::size_t>());
  EXPECT_EQ(count >= golden.input.at("m").get<std::size_t>(), golden.expected.at("match").get<bool>());
}

}  // namespace azimuth::golden
