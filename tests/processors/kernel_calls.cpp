// Calls one of the time-critical loops a given number of times; instructions_test.py counts the instructions of a call.
// The program is compiled twice: with the loops as shipped, and with loops without vector instructions.

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "slam/association/descriptor_block.hpp"
#include "slam/ekf/rank_update.hpp"
#include "slam/perception/colour/class_table.hpp"
#include "slam/perception/colour/scan.hpp"
#include "slam/perception/image/resample_kernels.hpp"
#include "slam/perception/lamps/bright_runs.hpp"
#include "slam/perception/sift/scale_space_kernels.hpp"

namespace azimuth {
namespace {

std::mt19937 random_bits;  // NOLINT(cert-msc32-c,cert-msc51-cpp): both programs need equal numbers

std::uint8_t byte() { return static_cast<std::uint8_t>(random_bits()); }

std::vector<std::uint8_t> bytes(std::size_t count) {
  std::vector<std::uint8_t> made(count);
  for (std::uint8_t& each : made) each = byte();
  return made;
}

Descriptor descriptor() {
  Descriptor made;
  for (std::uint8_t& each : made.values) each = byte();
  return made;
}

/// The matrix operations of an EKF with 30 landmarks in an update with ten bearings.
struct Filter {
  static constexpr Eigen::Index kSize = 63, kColumns = 20, kStride = LowerTriangle::padded(kSize);
  std::vector<double> covariance = std::vector<double>(kStride * kStride, 1.0);
  std::vector<double> columns = std::vector<double>(kStride * kColumns, 0.25);
  std::vector<double> factor = std::vector<double>(kColumns * kColumns, 0.01);

  Filter() {
    for (Eigen::Index i = 0; i < kColumns; ++i) factor[static_cast<std::size_t>(i * (kColumns + 1))] = 1.0;
  }
  void subtract() {
    subtract_symmetric_product({covariance.data(), kSize, kStride}, {columns.data(), kStride, kColumns, 0});
  }
  void whiten() { whiten_columns(columns.data(), kStride, kSize, factor.data(), kColumns, kColumns); }
};

struct Descriptors {
  DescriptorBlock block;
  std::vector<DescriptorQuery> queries;
  std::vector<std::int32_t> bounds = std::vector<std::int32_t>(kQueriesAtOnce, 100'000);
  NearLanes near;

  Descriptors() {
    for (std::size_t lane = 0; lane < DescriptorBlock::kLanes; ++lane) block.set(lane, descriptor());
    for (std::size_t i = 0; i < kQueriesAtOnce; ++i) queries.emplace_back(descriptor());
  }
  void find() { find_near(block, queries.data(), bounds.data(), near); }
};

/// The image of an octave, the blur and the search for extrema.
struct ScaleSpace {
  static constexpr int kWidth = 256, kHeight = 12, kRadius = 5;
  std::vector<float> in = intensities(), out = in, difference = in;
  std::vector<float> weights = std::vector<float>(kRadius + 1, 1.0F / (2 * kRadius + 1));
  std::vector<float> rows = std::vector<float>((2 * kRadius + 1) * kWidth);
  std::vector<float> padded = std::vector<float>(kWidth + 2 * kRadius + kScaleSpaceLanes);
  std::vector<std::int32_t> columns = std::vector<std::int32_t>(kWidth);

  static std::vector<float> intensities() {
    std::vector<float> made(std::size_t{kWidth} * kHeight);
    for (float& each : made) each = static_cast<float>(byte()) / 256.0F;
    return made;
  }
  void blur() {
    scale_space_kernels().blur({.in = in.data(),
                                .out = out.data(),
                                .difference = difference.data(),
                                .width = kWidth,
                                .height = kHeight,
                                .stride = kWidth,
                                .weights = weights.data(),
                                .radius = kRadius,
                                .rows = rows.data(),
                                .padded = padded.data()});
  }
  void find_extrema() {
    Neighbourhood nine;
    for (int i = 0; i < 9; ++i) nine.rows[i] = in.data() + std::ptrdiff_t{i} * kWidth;
    scale_space_kernels().find_extrema(nine, 1, kWidth - 1, 0.02F, columns.data());
  }
};

struct Resampling {
  std::vector<std::uint8_t> values = bytes(1024);
  std::vector<std::uint16_t> sums = std::vector<std::uint16_t>(1024);
  void add() { add_weighted(values.data(), 3, 1024, sums.data()); }
};

/// A YUYV row with a coloured landmark. The class table has one colour, because making a real one would take longer
/// than the loop.
struct Colours {
  static constexpr int kWidth = 1024;
  static constexpr std::uint8_t kGray = 128, kBlue = 240;
  std::vector<std::uint8_t> classes = std::vector<std::uint8_t>(std::size_t{1} << 3 * ClassTable::kBits);
  std::vector<std::uint8_t> row = std::vector<std::uint8_t>(2 * kWidth, kGray);
  std::vector<ColourRun> runs = std::vector<ColourRun>(64);

  Colours() {
    classes[ClassTable::index(kGray, kBlue, kGray)] = 1;
    for (std::size_t i = 801; i < 849; i += 4) row[i] = kBlue;
  }
  void find() {
    const Scan scan{row.data(),
                    {.pixels = PixelFormat::yuyv, .width_px = kWidth, .height_px = 1, .stride_bytes = 2 * kWidth},
                    classes.data(),
                    20};
    const VisibleSpan whole{.row = 0, .begin = 0, .end = kWidth};
    find_runs(scan, {&whole, 1}, runs);
  }
};

/// A grey row with two lamps.
struct Lamps {
  std::vector<std::uint8_t> row = std::vector<std::uint8_t>(1024, 7);
  std::vector<PixelRun> runs = std::vector<PixelRun>(64);

  Lamps() {
    for (std::size_t i = 300; i < 312; ++i) row[i] = row[i + 400] = 200;
  }
  void find() { bright_runs(row.data(), {.row = 0, .first = 0, .last = 1024}, 150, runs.data(), runs.size()); }
};

using Loop = void (*)(int times);

template <auto Call>
struct Times;

template <typename Data, void (Data::*Call)()>
struct Times<Call> {
  static void run(int times) {
    Data data;
    for (int i = 0; i < times; ++i) (data.*Call)();
  }
};

const std::map<std::string, Loop> kLoops{
    {"rank update", Times<&Filter::subtract>::run},        {"whitening", Times<&Filter::whiten>::run},
    {"descriptor search", Times<&Descriptors::find>::run}, {"blur", Times<&ScaleSpace::blur>::run},
    {"extrema", Times<&ScaleSpace::find_extrema>::run},    {"resampling", Times<&Resampling::add>::run},
    {"colour scan", Times<&Colours::find>::run},           {"bright runs", Times<&Lamps::find>::run}};

}  // namespace
}  // namespace azimuth

int main(int argc, char** argv) {
  if (argc == 3) azimuth::kLoops.at(argv[1])(std::atoi(argv[2]));  // NOLINT(cert-err34-c)
  for (const auto& [name, loop] : azimuth::kLoops)
    if (argc != 3) std::cout << name << '\n';
}
