#include "slam/perception/lamps/bright_runs.hpp"

#include <gmock/gmock.h>
#include <random>
#include <vector>

namespace azimuth {

static bool operator==(const PixelRun& a, const PixelRun& b) {
  return a.row == b.row && a.first == b.first && a.last == b.last;
}

namespace {

using Find = std::size_t (*)(const std::uint8_t*, const PixelRun&, int, PixelRun*, std::size_t);

std::vector<Find> variants() {
  std::vector<Find> all{&bright_runs, &portable::bright_runs};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") != 0) all.push_back(&avx2::bright_runs);
#endif
  return all;
}

/// The expected runs, computed pixel by pixel.
std::vector<PixelRun> expected(const std::vector<std::uint8_t>& pixels, const PixelRun& where, int level) {
  std::vector<PixelRun> runs;
  for (int u = where.first; u < where.last; ++u) {
    if (pixels[static_cast<std::size_t>(u)] < level) continue;
    if (runs.empty() || runs.back().last != u) runs.push_back({where.row, u, u});
    runs.back().last = u + 1;
  }
  return runs;
}

/// A row of random stretches above and below the level, so that runs start and end anywhere in a vector register.
std::vector<std::uint8_t> random_row(std::mt19937& engine, int level) {
  std::vector<std::uint8_t> row;
  std::uniform_int_distribution<int> size(150, 700), dark(0, level - 1), bright(level, 255);
  std::geometric_distribution<int> dark_length(0.02), bright_length(0.1);
  const auto end = static_cast<std::size_t>(size(engine));
  for (bool is_bright = false; row.size() < end; is_bright = !is_bright) {
    const int length = is_bright ? bright_length(engine) : dark_length(engine);
    for (int k = 0; k < length; ++k) row.push_back(static_cast<std::uint8_t>((is_bright ? bright : dark)(engine)));
  }
  return row;
}

TEST(BrightRuns, AreThoseFoundPixelByPixelAtEveryLevel) {
  std::mt19937 engine(1);
  for (int level = 1; level <= 255; ++level) {
    const std::vector<std::uint8_t> row = random_row(engine, level);
    const auto size = static_cast<int>(row.size());
    for (const PixelRun& where :
         {PixelRun{7, 0, size}, PixelRun{7, 3, size - 5}, PixelRun{7, 40, 41}, PixelRun{7, 9, 9}}) {
      for (const Find find : variants()) {
        std::vector<PixelRun> runs(row.size());
        runs.resize(find(row.data(), where, level, runs.data(), runs.size()));
        EXPECT_EQ(runs, expected(row, where, level)) << "level " << level;
      }
    }
  }
}

TEST(BrightRuns, StopWhereTheRoomEnds) {
  std::vector<std::uint8_t> row(300, 0);
  for (std::size_t u = 0; u < row.size(); u += 2) row[u] = 200;
  for (const Find find : variants()) {
    std::vector<PixelRun> runs(12, PixelRun{-1, -1, -1});
    EXPECT_EQ(find(row.data(), {0, 0, 300}, 100, runs.data(), 10), 10U);
    EXPECT_EQ(runs[9], (PixelRun{0, 18, 19}));
    EXPECT_EQ(runs[10], (PixelRun{-1, -1, -1})) << "nothing is written beyond";
    EXPECT_EQ(find(row.data(), {0, 0, 300}, 100, runs.data(), 0), 0U);
  }
}

}  // namespace
}  // namespace azimuth
