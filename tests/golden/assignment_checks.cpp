#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "slam/association/assignment.hpp"
#include "tests/golden/checks.hpp"

namespace azimuth::golden {
namespace {

using nlohmann::json;

struct Values {
  std::vector<double> row_major;
  std::size_t rows, columns;
  PairingTable table() const { return {row_major, rows, columns}; }
};

Values to_values(const json& rows, double (*value)(double)) {
  Values values{{}, rows.size(), rows.at(0).size()};
  for (const json& row : rows)
    for (const json& entry : row) values.row_major.push_back(value(entry.get<double>()));
  return values;
}

double as_it_is(double value) { return value; }
double logarithm(double value) { return std::log(value); }

std::vector<int> solved(const Values& values) {
  Assignment assignment;
  std::vector<int> column_of_row;
  EXPECT_TRUE(assignment.solve(values.table(), Objective::maximise, column_of_row));
  return column_of_row;
}

/// Gives each row in turn the best column that is left.
std::vector<int> greedy(const Values& values) {
  std::vector<int> column_of_row;
  for (std::size_t r = 0; r < values.rows; ++r) {
    int best = kUnassigned;
    for (int c = 0; c < static_cast<int>(values.columns); ++c) {
      const auto at = [&](int column) {
        return values.row_major[r * values.columns + static_cast<std::size_t>(column)];
      };
      if (std::ranges::count(column_of_row, c) == 0 && (best == kUnassigned || at(c) > at(best))) best = c;
    }
    column_of_row.push_back(best);
  }
  return column_of_row;
}

/// Rows whose columns all lie below the density of a new landmark stay without a column.
void check_with_new(const GoldenCase& golden) {
  ASSERT_EQ(golden.input.at("cost"), "log");
  const Values values = to_values(golden.input.at("Phi"), logarithm);
  const std::vector<double> alone(values.rows, std::log(golden.input.at("P_new").get<double>()));
  Assignment assignment;
  std::vector<int> column_of_row;
  assignment.solve(values.table(), alone, Objective::maximise, column_of_row);
  EXPECT_EQ(column_of_row, golden.expected.at("psi").get<std::vector<int>>());
}

}  // namespace

void check_hungarian(const GoldenCase& golden) {
  if (golden.input.contains("P_new")) return check_with_new(golden);
  ASSERT_TRUE(golden.input.at("maximize").get<bool>());
  const Values values = to_values(golden.input.at("Phi"), as_it_is);
  const std::vector<int> found = solved(values);
  if (golden.expected.contains("col_of_row_sum")) {
    EXPECT_EQ(found, golden.expected.at("col_of_row_sum").get<std::vector<int>>());
    EXPECT_EQ(solved(to_values(golden.input.at("Phi"), logarithm)),
              golden.expected.at("col_of_row_log").get<std::vector<int>>());
    EXPECT_EQ(greedy(values), golden.expected.at("greedy_ml").get<std::vector<int>>());
    return;
  }
  EXPECT_EQ(found, golden.expected.at("col_of_row").get<std::vector<int>>());
  double sum = 0.0;
  for (std::size_t r = 0; r < values.rows; ++r)
    sum += values.row_major[r * values.columns + static_cast<std::size_t>(found[r])];
  expect_near(sum, golden.expected.at("value"), golden.tolerance, "value");
}

}  // namespace azimuth::golden
