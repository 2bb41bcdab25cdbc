#pragma once
// Samples for the tests of messages and recordings, and their comparison.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "drivers/wire/truth.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth::test {

using Buffer = std::vector<std::byte>;
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A set of features with descriptors that differ in every byte; each has some of the others as neighbours.
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

}  // namespace azimuth::test
