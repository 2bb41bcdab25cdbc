// 100 descriptors against 100,000: the exact 8-bit search of the descriptor store and OpenCV's brute-force matcher,
// both for the two nearest by Euclidean distance. cv::BFMatcher does less: its second nearest may belong to the same
// landmark.

#include <algorithm>
#include <benchmark/benchmark.h>
#include <opencv2/core/utility.hpp>
#include <opencv2/features2d.hpp>
#include <random>
#include <vector>

#include "slam/association/descriptor_loops.hpp"
#include "slam/association/descriptor_store.hpp"

namespace azimuth {
namespace {

constexpr int kQueries = 100;
constexpr int kValues = 128;

/// A random descriptor with long tails and many small values, like a gradient histogram.
Descriptor random_looks(std::mt19937& engine) {
  std::exponential_distribution<double> value(1.0 / 30.0);
  Descriptor descriptor;
  for (std::uint8_t& entry : descriptor.values) entry = static_cast<std::uint8_t>(std::min(255.0, value(engine)));
  return descriptor;
}

std::vector<Descriptor> random_looks(int count) {
  std::mt19937 engine(1);
  std::vector<Descriptor> descriptors;
  for (int k = 0; k < count; ++k) descriptors.push_back(random_looks(engine));
  return descriptors;
}

void store_search(benchmark::State& state) {
  const int stored = static_cast<int>(state.range(0));
  DescriptorStoreSettings settings;
  settings.max_views = stored;
  settings.keep_patterns = false;
  DescriptorStore store(settings);
  Identity identity = 0;
  for (const Descriptor& descriptor : random_looks(stored)) store.see(identity++, descriptor, {}, {0.0, 0.0}, 0.0);
  const std::vector<Descriptor> queries = random_looks(kQueries);
  std::vector<NearestTwo> found;
  for (auto _ : state) {
    store.find(queries, {1.0, 0.0}, found);
    benchmark::DoNotOptimize(found.data());
  }
}
BENCHMARK(store_search)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMillisecond);

/// The search loops alone, in the variant for one kind of processor.
template <auto find>
void loops(benchmark::State& state) {
  std::vector<DescriptorBlock> blocks(static_cast<std::size_t>(state.range(0)) / DescriptorBlock::kLanes);
  std::mt19937 engine(1);
  for (DescriptorBlock& block : blocks)
    for (std::size_t lane = 0; lane < DescriptorBlock::kLanes; ++lane) block.set(lane, random_looks(engine));
  std::vector<DescriptorQuery> queries;
  for (const Descriptor& descriptor : random_looks(kQueries)) queries.emplace_back(descriptor);
  const std::int32_t bounds[kQueriesAtOnce] = {};
  NearLanes near;
  for (auto _ : state)
    for (const DescriptorBlock& block : blocks)
      for (std::size_t q = 0; q < queries.size(); q += kQueriesAtOnce) {
        find(block, &queries[q], bounds, near);
        benchmark::DoNotOptimize(near);
      }
}
BENCHMARK(loops<portable::find_near>)->Name("loops_portable")->Arg(100'000)->Unit(benchmark::kMillisecond);
BENCHMARK(loops<avx2::find_near>)->Name("loops_avx2")->Arg(100'000)->Unit(benchmark::kMillisecond);
BENCHMARK(loops<avx512::find_near>)->Name("loops_avx512")->Arg(100'000)->Unit(benchmark::kMillisecond);

cv::Mat as_rows(const std::vector<Descriptor>& descriptors, int type) {
  cv::Mat rows(static_cast<int>(descriptors.size()), kValues, CV_8U);
  for (int r = 0; r < rows.rows; ++r)
    std::ranges::copy(descriptors[static_cast<std::size_t>(r)].values, rows.ptr<std::uint8_t>(r));
  rows.convertTo(rows, type);
  return rows;
}

void opencv_brute_force(benchmark::State& state, int type) {
  cv::setNumThreads(1);
  const cv::Mat stored = as_rows(random_looks(static_cast<int>(state.range(0))), type);
  const cv::Mat queries = as_rows(random_looks(kQueries), type);
  const cv::BFMatcher matcher(cv::NORM_L2);
  std::vector<std::vector<cv::DMatch>> found;
  for (auto _ : state) {
    matcher.knnMatch(queries, stored, found, 2);
    benchmark::DoNotOptimize(found.data());
  }
}
BENCHMARK_CAPTURE(opencv_brute_force, 8_bit, CV_8U)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(opencv_brute_force, float, CV_32F)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace azimuth
