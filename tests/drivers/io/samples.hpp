#pragma once
// Small runs for the tests of drivers/io, and how to compare them.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/io/run.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth::test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

inline void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

inline std::string read(const std::filesystem::path& file) {
  std::ostringstream out;
  out << std::ifstream(file, std::ios::binary).rdbuf();
  return out.str();
}

/// Everything a run can hold, with values that do not come out of decimal text by luck.
inline Run example_run(std::size_t steps = 6, unsigned seed = 1) {
  std::mt19937_64 bits(seed);
  const auto random = [&bits](double scale) { return scale * (static_cast<double>(bits() >> 11U) * 0x1p-53 - 0.5); };
  const auto pose = [&random] { return Pose2{random(40.0), random(1e-3), random(2.0 * std::numbers::pi)}; };
  Run run;
  run.rig_toml = "front_end = \"bearings\"\n";
  for (std::size_t i = 0; i < steps; ++i) {
    const auto t_us = static_cast<std::int64_t>(i) * 100'000 - 50'001;  // odometers with a lag begin before 0
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

/// A set of features with looks that differ in every byte, each knowing some of the others.
inline BearingSet feature_set(std::size_t count, std::uint64_t sequence = 1) {
  BearingSet set{stamp_from_us(static_cast<std::int64_t>(sequence) * 100'000), sequence, {}};
  for (std::size_t i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(count);
    set.bearings.push_back({.azimuth_rad = 6.0 * part - 3.0,
                            .elevation_rad = i % 3 == 0 ? kNaN : part,
                            .identity = i % 5 == 0 ? 4 : kUnknownIdentity,
                            .kind = static_cast<Kind>(i % 4) - 1,
                            .sigma_rad = i % 2 == 0 ? kNaN : 0.01 + part,
                            .radius_px = i % 7 == 0 ? kNaN : 300.0 * part,
                            .sigma_elevation_rad = i % 11 == 0 ? kNaN : 0.02 + part});
    Descriptor& descriptor = set.descriptors.emplace_back();
    for (std::size_t k = 0; k < descriptor.values.size(); ++k)
      descriptor.values[k] = static_cast<std::uint8_t>(7 * i + k + sequence);
    Neighbours& neighbours = set.neighbours.emplace_back();
    for (std::size_t k = 0; k < i % 6 && k < count; ++k)
      neighbours.index[k] = static_cast<std::uint16_t>(count - 1 - k);
  }
  return set;
}

inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

inline bool same_bits(const Pose2& a, const Pose2& b) {
  return same_bits(a.x_m, b.x_m) && same_bits(a.y_m, b.y_m) && same_bits(a.heading_rad, b.heading_rad);
}

inline bool same_bits(const Bearing& a, const Bearing& b) {
  return same_bits(a.azimuth_rad, b.azimuth_rad) && same_bits(a.elevation_rad, b.elevation_rad) &&
         a.identity == b.identity && a.kind == b.kind && same_bits(a.sigma_rad, b.sigma_rad) &&
         same_bits(a.radius_px, b.radius_px) && same_bits(a.sigma_elevation_rad, b.sigma_elevation_rad);
}

inline bool same_bits(const BearingSet& a, const BearingSet& b) {
  return a.stamp == b.stamp && a.sequence == b.sequence && a.trouble == b.trouble && a.descriptors == b.descriptors &&
         a.neighbours == b.neighbours &&
         std::ranges::equal(a.bearings, b.bearings, [](const Bearing& x, const Bearing& y) { return same_bits(x, y); });
}

inline bool same_bits(const OdometryReading& a, const OdometryReading& b) {
  return a.stamp == b.stamp && a.sequence == b.sequence && a.origin == b.origin &&
         same_bits(a.T_odom_body, b.T_odom_body);
}

inline bool same_bits(const TruthPose& a, const TruthPose& b) {
  return a.stamp == b.stamp && same_bits(a.T_world_body, b.T_world_body);
}

inline bool same_bits(const TrueLandmark& a, const TrueLandmark& b) {
  return a.identity == b.identity && same_bits(a.x_m, b.x_m) && same_bits(a.y_m, b.y_m) && same_bits(a.z_m, b.z_m) &&
         a.kind == b.kind;
}

template <class Record>
bool same_bits(const std::vector<Record>& a, const std::vector<Record>& b) {
  return std::ranges::equal(a, b, [](const Record& x, const Record& y) { return same_bits(x, y); });
}

/// Those of a log are elsewhere than those of a folder.
inline bool same_frames(const std::vector<FrameFile>& a, const std::vector<FrameFile>& b) {
  return std::ranges::equal(a, b, [](const FrameFile& x, const FrameFile& y) {
    return x.stamp == y.stamp && (x.part || y.part || x.file == y.file);
  });
}

/// Everything but name, place and what was skipped.
inline void expect_same_samples(const Run& a, const Run& b) {
  EXPECT_EQ(a.rig_toml, b.rig_toml);
  EXPECT_TRUE(same_frames(a.frames, b.frames));
  EXPECT_TRUE(same_bits(a.odometry, b.odometry));
  EXPECT_TRUE(same_bits(a.bearings, b.bearings));
  EXPECT_TRUE(same_bits(a.truth, b.truth));
  EXPECT_TRUE(same_bits(a.landmarks, b.landmarks));
}

}  // namespace azimuth::test
