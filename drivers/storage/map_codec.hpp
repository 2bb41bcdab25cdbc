#pragma once
// Map files, as bytes: a header with the version and every size, the map, and a checksum over all of it. Little-endian
// on every machine, and doubles bit for bit.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// What a map file begins with; the version follows.
inline constexpr std::string_view kMapMagic = "azimuth map\n";
inline constexpr std::uint32_t kMapVersion = 1;
/// Beyond this no map is written or read, so that a field log can hold it as a document.
inline constexpr std::size_t kMaxMapBytes = 250'000'000;

/// Bytes that `map` takes as a file.
std::size_t encoded_size(const MapSnapshot& map);

/// Replaces `out`. The map must be one of implausible() == nothing.
void encode(const MapSnapshot& map, std::vector<std::byte>& out);

/// Whether the bytes are a whole map of this version: magic, size, checksum, version. Nothing: they are; else what is
/// wrong.
std::optional<std::string> damage_of(Bytes bytes);

/// Of bytes that damage_of() finds whole: with it other files name this very map.
std::uint32_t map_checksum(Bytes bytes);

/// Reads a map into `out`, of which nothing is to be used when something is wrong: that is returned.
std::optional<std::string> decode_map(Bytes bytes, MapSnapshot& out);

/// What no estimator would have written: values that are not finite or absurd, a covariance that is none, identifiers
/// that contradict each other. Nothing: the map is sound. Takes seconds for thousands of landmarks.
std::optional<std::string> implausible(const MapSnapshot& map);

}  // namespace azimuth
