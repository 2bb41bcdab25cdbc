#include "slam/ekf/column_sum.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "slam/ekf/column_sum_loops.hpp"  // the baseline path, which processors with AVX2 do not use
#include "slam/geometry/index.hpp"
#include "tests/geometry/random_draws.hpp"

namespace azimuth {
namespace {

std::vector<double> draw(Index count, RandomDraws& draws) {
  std::vector<double> values(as_size(count));
  for (double& value : values) value = draws.normal();
  return values;
}

/// Parts of one to five columns with a stride, from any first row on, and a sum with initial values.
struct ColumnProblem {
  Index size;
  std::vector<double> out, matrix, factors;
  std::vector<ScaledColumns> parts;

  ColumnProblem(Index size_in, int count, RandomDraws& draws)
      : size(size_in), out(draw(size_in + 8, draws)), factors(draw(5 * count, draws)) {
    const Index stride = size + draws.integer(0, 9);
    matrix = draw(stride * 5 * count + 16, draws);
    for (int p = 0; p < count; ++p) {
      const Index column = 5 * p, row = draws.integer(0, 8);
      parts.push_back(
          {&matrix[as_size(stride * column + row)], stride, &factors[as_size(column)], draws.integer(1, 5)});
    }
  }

  /// The result includes the elements behind the sum's rows, which must not change.
  template <class Add>
  std::vector<double> result_of(Add add) const {
    std::vector<double> result = out;
    add(parts.data(), as_index(parts.size()), size, result.data());
    return result;
  }
};

void add_columns_by_definition(const ScaledColumns* parts, Index count, Index size, double* out) {
  for (Index row = 0; row < size; ++row)
    for (Index p = 0; p < count; ++p) {
      double sum = parts[p].factors[0] * parts[p].first[row];
      for (Index s = 1; s < parts[p].count; ++s) sum += parts[p].factors[s] * parts[p].first[s * parts[p].stride + row];
      out[row] += sum;
    }
}

/// All paths agree to the last bit, because none of them fuses multiply-adds.
TEST(ColumnSum, EveryPathEqualsItsDefinition) {
  RandomDraws draws(61);
  for (Index size = 0; size <= 70; ++size)
    for (const int count : {0, 1, 2, 5, 22}) {
      SCOPED_TRACE(testing::Message() << size << " rows, " << count << " parts");
      const ColumnProblem problem(size, count, draws);
      const std::vector<double> expected = problem.result_of(add_columns_by_definition);
      EXPECT_EQ(problem.result_of(add_all_columns), expected);
      EXPECT_EQ(problem.result_of([](const ScaledColumns* parts, Index parts_count, Index rows, double* out) {
        add_columns({parts, as_size(parts_count)}, rows, out);
      }),
                expected);
#if defined(__x86_64__)
      if (__builtin_cpu_supports("avx2") != 0) {
        EXPECT_EQ(problem.result_of(avx2::add_columns), expected);
      }
#endif
    }
}

}  // namespace
}  // namespace azimuth
