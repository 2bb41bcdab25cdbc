#pragma once
// Distances between descriptors, many at once. Integers throughout: the result is the same on every processor.

#include <array>
#include <cstddef>
#include <cstdint>

#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Descriptors of several features side by side, one to a lane: four values of lane 0, the same four of lane 1, and so
/// on. So one register holds values of many features, and their sums need not be gathered from within it.
struct alignas(64) DescriptorBlock {
  static constexpr std::size_t kLanes = 16;
  static constexpr std::size_t kValues = 128;

  std::array<std::uint8_t, kValues * kLanes> values{};
  std::array<std::int32_t, kLanes> sum{};           ///< of the lane's values
  std::array<std::int32_t, kLanes> squared_norm{};  ///< of the lane's values

  void set(std::size_t lane, const Descriptor& descriptor);
  Descriptor get(std::size_t lane) const;
};

/// A descriptor whose nearest are wanted, in the forms the loops multiply by.
struct alignas(64) DescriptorQuery {
  static constexpr std::size_t kWords = DescriptorBlock::kValues / 4;

  // Of each four values a, b, c, d: a and c, b and d as 16-bit halves of a word; all four less 128 as its bytes.
  std::array<std::uint32_t, kWords> even{}, odd{}, centred{};
  std::int32_t squared_norm = 0;

  DescriptorQuery() = default;
  explicit DescriptorQuery(const Descriptor& descriptor);
};

/// Queries that are worked on together, so that what is loaded of a block serves several.
inline constexpr std::size_t kQueriesAtOnce = 4;

/// What of a block lies nearer to each query than its bound.
struct NearLanes {
  /// Squared Euclidean distance of every lane, near or not.
  alignas(64) std::array<std::array<std::int32_t, DescriptorBlock::kLanes>, kQueriesAtOnce> squared_distance;
  std::array<std::uint32_t, kQueriesAtOnce> near;  ///< a bit for each lane below the bound
};

/// Compares a block with kQueriesAtOnce queries; `bounds` are squared distances.
void find_near(const DescriptorBlock& block, const DescriptorQuery* queries, const std::int32_t* bounds,
               NearLanes& out);

/// Sum of the products of two descriptors' values.
std::int32_t dot_product(const Descriptor& a, const Descriptor& b);

}  // namespace azimuth
