#pragma once
// Small runs for the tests of storage, and their comparison.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/storage/run.hpp"
#include "tests/drivers/wire/samples.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth::test {

inline void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

inline std::string read(const std::filesystem::path& file) {
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

/// A run with all kinds of content. Its values are not exactly representable in short decimal text.
inline Run example_run(std::size_t steps = 6, unsigned seed = 1) {
  std::mt19937_64 bits(seed);
  const auto random = [&bits](double scale) { return scale * (static_cast<double>(bits() >> 11U) * 0x1p-53 - 0.5); };
  const auto pose = [&random] { return Pose2{random(40.0), random(1e-3), random(2.0 * std::numbers::pi)}; };
  Run run;
  run.rig_toml = "front_end = \"bearings\"\n";
  for (std::size_t i = 0; i < steps; ++i) {
    const auto t_us = static_cast<std::int64_t>(i) * 100'000 - 50'001;  // odometers with a lag start before 0
    run.odometry.push_back({stamp_from_us(t_us), i, 0, pose()});
    run.truth.push_back({stamp_from_us(t_us + 1), pose()});
    BearingSet set{stamp_from_us(t_us + (i % 2 == 0 ? 0 : 33'333)), run.bearings.size(), {}};
    for (std::size_t k = 0; k < i % 4; ++k) {  // sets of 0, 1, 2 and 3
      const double elevation_rad = k == 1 ? kNaN : random(1.0);
      set.bearings.push_back({random(6.0), elevation_rad, k == 2 ? kUnknownIdentity : static_cast<Identity>(k)});
    }
    if (i % 4 == 3)
      set.bearings[1].kind = 2, set.bearings[2].sigma_rad = 0.01 / 3.0, set.bearings[0].radius_px = 100.0 / 3.0,
      set.bearings[1].sigma_elevation_rad = 0.02 / 3.0;
    if (i % 8 == 4) set.trouble = ImageTrouble::dark;
    run.bearings.push_back(std::move(set));
  }
  run.frames = {{stamp_from_us(0), "frames/000000.jpg"}, {stamp_from_us(527'001), "frames/000001.jpg"}};
  run.landmarks = {{3, random(9.0), random(9.0), kNaN, ""}, {1, random(9.0), random(9.0), random(9.0), "lamp"}};
  return run;
}

/// Frames of a log are located differently from those of a folder, so their file is not compared.
inline bool same_frames(const std::vector<FrameFile>& a, const std::vector<FrameFile>& b) {
  return std::ranges::equal(a, b, [](const FrameFile& x, const FrameFile& y) {
    return x.stamp == y.stamp && (x.part || y.part || x.file == y.file);
  });
}

/// Compares everything except the name, the location and the skipped samples.
inline void expect_same_samples(const Run& a, const Run& b) {
  EXPECT_EQ(a.rig_toml, b.rig_toml);
  EXPECT_TRUE(same_frames(a.frames, b.frames));
  EXPECT_TRUE(same_bits(a.odometry, b.odometry));
  EXPECT_TRUE(same_bits(a.bearings, b.bearings));
  EXPECT_TRUE(same_bits(a.truth, b.truth));
  EXPECT_TRUE(same_bits(a.landmarks, b.landmarks));
}

}  // namespace azimuth::test
