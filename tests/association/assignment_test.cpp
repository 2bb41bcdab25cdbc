#include "slam/association/assignment.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <optional>
#include <random>

#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

struct PairingProblem {
  std::vector<double> values;
  std::size_t rows, columns;
  std::vector<double> alone;  // cost of leaving each row unassigned; empty: no row may stay unassigned
  PairingTable table() const { return {values, rows, columns}; }
};

PairingProblem random_problem(std::mt19937& engine, std::size_t rows, std::size_t columns, double gated, bool ties) {
  std::uniform_real_distribution<double> value(-5.0, 10.0), chance(0.0, 1.0);
  PairingProblem problem{std::vector<double>(rows * columns), rows, columns, {}};
  for (double& entry : problem.values) {
    entry = ties ? std::floor(value(engine) / 4.0) : value(engine);
    if (chance(engine) < gated) entry = kInf;
  }
  return problem;
}

double value_of(const PairingProblem& problem, const std::vector<int>& column_of_row) {
  double sum = 0.0;
  for (std::size_t r = 0; r < problem.rows; ++r) {
    if (column_of_row[r] != kUnassigned)
      sum += problem.values[r * problem.columns + static_cast<std::size_t>(column_of_row[r])];
    else if (!problem.alone.empty())
      sum += problem.alone[r];
  }
  return sum;
}

/// The least cost over all assignments of the rows from `row` on, by trying every one of them.
double exhaustive(const PairingProblem& problem, std::size_t row, unsigned used, std::size_t left_out) {
  if (row == problem.rows) return 0.0;
  double best = kInf;
  if (!problem.alone.empty()) {
    best = problem.alone[row] + exhaustive(problem, row + 1, used, left_out);
  } else if (left_out > 0) {
    best = exhaustive(problem, row + 1, used, left_out - 1);
  }
  for (std::size_t c = 0; c < problem.columns; ++c) {
    const double value = problem.values[row * problem.columns + c];
    if ((used >> c & 1u) != 0 || value == kInf) continue;
    best = std::min(best, value + exhaustive(problem, row + 1, used | 1u << c, left_out));
  }
  return best;
}

double exhaustive(const PairingProblem& problem) {
  return exhaustive(problem, 0, 0, problem.rows > problem.columns ? problem.rows - problem.columns : 0);
}

void expect_one_to_one(const std::vector<int>& column_of_row) {
  std::vector<int> taken;
  std::ranges::copy_if(column_of_row, std::back_inserter(taken), [](int column) { return column != kUnassigned; });
  std::ranges::sort(taken);
  EXPECT_EQ(std::ranges::adjacent_find(taken), taken.end());
}

TEST(Assignment, AgreesWithExhaustiveSearch) {
  std::mt19937 engine(1);
  Assignment assignment;
  std::vector<int> found;
  int infeasible = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const std::size_t rows = 1 + engine() % 6, columns = 1 + engine() % 6;
    const PairingProblem problem = random_problem(engine, rows, columns, 0.1 * (trial % 7), trial % 3 == 0);
    const double best = exhaustive(problem);
    const bool solved = assignment.solve(problem.table(), Objective::minimise, found);
    ASSERT_EQ(solved, best < kInf) << trial;
    if (!solved) {
      ++infeasible;
      continue;
    }
    expect_one_to_one(found);
    ASSERT_EQ(std::ranges::count_if(found, [](int c) { return c != kUnassigned; }),
              static_cast<std::ptrdiff_t>(std::min(rows, columns)));
    ASSERT_NEAR(value_of(problem, found), best, 1e-12) << trial;
  }
  EXPECT_GT(infeasible, 100) << "gates that forbid everything were tried";
}

TEST(Assignment, LeavesRowsAloneWhereThatIsBetter) {
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> value(-5.0, 10.0);
  Assignment assignment;
  std::vector<int> found;
  int alone = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const std::size_t rows = 1 + engine() % 6, columns = engine() % 6;
    PairingProblem problem = random_problem(engine, rows, columns, 0.1 * (trial % 9), trial % 3 == 0);
    for (std::size_t r = 0; r < rows; ++r) problem.alone.push_back(trial % 2 == 0 ? 1.0 : value(engine));
    assignment.solve(problem.table(), problem.alone, Objective::minimise, found);
    expect_one_to_one(found);
    alone += static_cast<int>(std::ranges::count(found, kUnassigned));
    ASSERT_NEAR(value_of(problem, found), exhaustive(problem), 1e-12) << trial;
  }
  EXPECT_GT(alone, 1000);
}

TEST(Assignment, MaximisingIsMinimisingTheNegative) {
  std::mt19937 engine(3);
  Assignment assignment;
  std::vector<int> found, negated;
  for (int trial = 0; trial < 300; ++trial) {
    PairingProblem problem = random_problem(engine, 1 + engine() % 12, 1 + engine() % 12, 0.1, false);
    const bool solved = assignment.solve(problem.table(), Objective::minimise, found);
    for (double& entry : problem.values) entry = -entry;
    ASSERT_EQ(assignment.solve(problem.table(), Objective::maximise, negated), solved);
    if (solved) {
      ASSERT_EQ(found, negated);
    }
  }
}

/// The problem is too large for an exhaustive search. Shifting the values of a row or a column changes the value of
/// every complete assignment by the same amount, so the optimal assignment must stay the same.
TEST(Assignment, ShiftsOfRowsAndColumnsChangeNothing) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> shift(-50.0, 50.0);
  Assignment assignment;
  std::vector<int> before, after;
  for (int trial = 0; trial < 20; ++trial) {
    PairingProblem problem = random_problem(engine, 60, 60, 0.5, false);
    ASSERT_TRUE(assignment.solve(problem.table(), Objective::minimise, before));
    std::vector<double> of_column(problem.columns);
    for (double& entry : of_column) entry = shift(engine);
    for (std::size_t r = 0; r < problem.rows; ++r) {
      const double of_row = shift(engine);
      for (std::size_t c = 0; c < problem.columns; ++c)
        problem.values[r * problem.columns + c] += of_row + of_column[c];
    }
    ASSERT_TRUE(assignment.solve(problem.table(), Objective::minimise, after));
    EXPECT_EQ(before, after);
  }
}

TEST(Assignment, NothingToAssign) {
  Assignment assignment;
  std::vector<int> found{7};
  EXPECT_TRUE(assignment.solve({}, Objective::minimise, found));
  EXPECT_TRUE(found.empty());
  EXPECT_TRUE(assignment.solve({{}, 3, 0}, Objective::minimise, found)) << "no column, so none needs a row";
  EXPECT_EQ(found, std::vector<int>(3, kUnassigned));
}

TEST(Assignment, AllTiesEnd) {
  Assignment assignment;
  std::vector<int> found;
  const PairingProblem problem{std::vector<double>(200 * 300, 1.0), 200, 300, {}};
  ASSERT_TRUE(assignment.solve(problem.table(), Objective::minimise, found));
  expect_one_to_one(found);
}

TEST(Assignment, DoesNotAllocateOnceGrown) {
  std::mt19937 engine(5);
  std::vector<PairingProblem> problems;
  for (int k = 0; k < 20; ++k) problems.push_back(random_problem(engine, 20, 40, 0.6, false));
  for (PairingProblem& problem : problems) problem.alone.assign(problem.rows, 4.0);
  Assignment assignment;
  std::vector<int> found;
  assignment.solve(problems.front().table(), problems.front().alone, Objective::minimise, found);
  const std::size_t before = allocations();
  for (const PairingProblem& problem : problems)
    assignment.solve(problem.table(), problem.alone, Objective::minimise, found);
  EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace azimuth
