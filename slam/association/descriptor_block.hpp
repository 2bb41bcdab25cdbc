#pragma once
// Distances between many descriptors at once. Integer arithmetic throughout: the result is the same on every processor.

#include <array>
#include <cstddef>
#include <cstdint>

#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Descriptors of several features, one per lane, interleaved: four values of lane 0, the same four of lane 1, and so
/// on. A register thus holds values of many features, and no sums across a register are needed.
struct alignas(64) DescriptorBlock {
  static constexpr std::size_t kLanes = 16;
  static constexpr std::size_t kValues = 128;

  std::array<std::uint8_t, kValues * kLanes> values{};
  std::array<std::int32_t, kLanes> sum{};           ///< Sum of the lane's values
  std::array<std::int32_t, kLanes> squared_norm{};  ///< Sum of the lane's squared values

  void set(std::size_t lane, const Descriptor& descriptor);
  Descriptor get(std::size_t lane) const;
};

/// A descriptor to be compared with blocks, in the forms that the loops multiply by.
struct alignas(64) DescriptorQuery {
  static constexpr std::size_t kWords = DescriptorBlock::kValues / 4;

  // For each four values a, b, c, d: `even` holds a and c, `odd` holds b and d as 16-bit halves of a word; `centred`
  // holds all four, less 128, as signed bytes.
  std::array<std::uint32_t, kWords> even{}, odd{}, centred{};
  std::int32_t squared_norm = 0;

  DescriptorQuery() = default;
  explicit DescriptorQuery(const Descriptor& descriptor);
};

/// Queries processed together, so that each loaded value of a block serves several queries.
inline constexpr std::size_t kQueriesAtOnce = 4;

/// The lanes of a block that are nearer to each query than the query's bound.
struct NearLanes {
  /// Squared Euclidean distance for every lane, near or not.
  alignas(64) std::array<std::array<std::int32_t, DescriptorBlock::kLanes>, kQueriesAtOnce> squared_distance;
  std::array<std::uint32_t, kQueriesAtOnce> near;  ///< One bit per lane, set if the distance is below the bound
};

/// Compares a block with kQueriesAtOnce queries; `bounds` are squared distances.
void find_near(const DescriptorBlock& block, const DescriptorQuery* queries, const std::int32_t* bounds,
               NearLanes& out);

/// Sum of the products of two descriptors' values.
std::int32_t dot_product(const Descriptor& a, const Descriptor& b);

}  // namespace azimuth
