// Compares the assignment of large problems with dlib's solver, if dlib is installed (scripts/setup --bench).

#include <gtest/gtest.h>
#include <random>

#include "slam/association/assignment.hpp"
#if defined(AZIMUTH_HAS_DLIB)
#include <dlib/optimization/max_cost_assignment.h>
#endif

namespace azimuth {
namespace {

#if defined(AZIMUTH_HAS_DLIB)
struct Profits {
  std::vector<double> values;
  dlib::matrix<long long> padded;  // square: rows of zero profit fill it up
};

Profits random_profits(std::mt19937& engine, int rows, int columns, int largest) {
  std::uniform_int_distribution<int> profit(0, largest);
  Profits profits{{}, dlib::matrix<long long>(columns, columns)};
  profits.padded = 0;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      profits.padded(r, c) = profit(engine);
      profits.values.push_back(static_cast<double>(profits.padded(r, c)));
    }
  return profits;
}

TEST(AssignmentBesideDlib, EarnsAsMuch) {
  std::mt19937 engine(6);
  Assignment assignment;
  std::vector<int> found;
  for (int trial = 0; trial < 30; ++trial) {
    const int rows = 5 + 3 * trial, columns = rows + static_cast<int>(engine() % 40);
    const Profits profits = random_profits(engine, rows, columns, trial % 2 == 0 ? 20 : 1'000'000);
    const PairingTable table{profits.values, static_cast<std::size_t>(rows), static_cast<std::size_t>(columns)};
    ASSERT_TRUE(assignment.solve(table, Objective::maximise, found));
    std::vector<long> all(found.begin(), found.end());
    std::vector<bool> used(static_cast<std::size_t>(columns), false);
    for (const int column : found) used[static_cast<std::size_t>(column)] = true;
    for (int column = 0; column < columns; ++column)
      if (!used[static_cast<std::size_t>(column)]) all.push_back(column);  // the padding rows take the unused columns
    EXPECT_EQ(dlib::assignment_cost(profits.padded, all),
              dlib::assignment_cost(profits.padded, dlib::max_cost_assignment(profits.padded)));
  }
}
#else
TEST(AssignmentBesideDlib, EarnsAsMuch) { GTEST_SKIP() << "dlib is not installed: scripts/setup --bench"; }
#endif

}  // namespace
}  // namespace azimuth
