#pragma once
// Map files as bytes: a header with the version and all sizes, the map, and a checksum over everything. Little-endian
// on every machine, doubles bit for bit.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// The beginning of a map file; the version follows.
inline constexpr std::string_view kMapMagic = "azimuth map\n";
inline constexpr std::uint32_t kMapVersion = 1;
/// Larger maps are neither written nor read, so that a field log can hold a map as a document.
inline constexpr std::size_t kMaxMapBytes = 250'000'000;

/// Size of `map` as a file [bytes].
std::size_t encoded_size(const MapSnapshot& map);

/// Replaces `out`. Requires that implausible(map) returns none.
void encode(const MapSnapshot& map, std::vector<std::byte>& out);

/// Checks that the bytes are a complete map of this version: magic, size, checksum, version. None: they are; otherwise
/// what is wrong.
std::optional<std::string> damage_of(Bytes bytes);

/// The checksum by which other files refer to this map. Requires that damage_of() returns none.
std::uint32_t map_checksum(Bytes bytes);

/// Reads a map into `out`. Returns what is wrong, in which case `out` must not be used; none: success.
std::optional<std::string> decode_map(Bytes bytes, MapSnapshot& out);

/// Finds values that no estimator would write: values that are not finite or absurd, an invalid covariance,
/// contradictory identifiers. None: the map is sound. Takes seconds for thousands of landmarks.
std::optional<std::string> implausible(const MapSnapshot& map);

}  // namespace azimuth
