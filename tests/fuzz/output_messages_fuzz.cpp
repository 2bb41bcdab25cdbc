// Any bytes as messages of a daemon. They must be refused or valid, and so must maps and paths from such pieces in any
// order.
//
// Input: messages, each after one byte for its type and two for its length.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "drivers/wire/messages.hpp"
#include "drivers/wire/pieces.hpp"
#include "drivers/wire/plausible.hpp"

namespace azimuth {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void take(std::uint8_t what, Bytes data, MapPieces& map, PathPieces& path) {
  switch (what % 7) {
    case 0:
      if (const auto pose = decode_pose(data)) require(is_plausible_stamp(pose->utime));
      break;
    case 1:
      if (const auto piece = decode_map_chunk(data); piece && map.take(*piece))
        for (const landmark_t& landmark : map.whole()) require(is_plausible_coordinate(landmark.x_m));
      break;
    case 2:
      if (const auto piece = decode_path(data); piece && path.take(*piece))
        for (const path_pose_t& pose : path.whole()) require(is_plausible_stamp(pose.utime));
      break;
    case 3:
      if (const auto sightings = decode_sightings(data)) require(sightings->sightings.size() * 32 < data.size());
      break;
    case 4:
      if (const auto expected = decode_expectations(data)) require(expected->expected.size() * 52 < data.size());
      break;
    case 5:
      if (const auto kept = decode_kept(data)) require(kept->log_size >= -1);
      break;
    default:
      if (const auto status = decode_status(data))
        require(status->reason.size() + status->recorder.size() < data.size());
  }
}

}  // namespace
}  // namespace azimuth

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  azimuth::MapPieces map;
  azimuth::PathPieces path;
  for (azimuth::Bytes rest = std::as_bytes(std::span(data, size)); rest.size() > 3;) {
    const auto what = std::to_integer<std::uint8_t>(rest[0]);
    const std::size_t length = std::to_integer<std::size_t>(rest[1]) + 256 * std::to_integer<std::size_t>(rest[2]);
    rest = rest.subspan(3);
    const azimuth::Bytes message = rest.first(std::min(length, rest.size()));
    azimuth::take(what, message, map, path);
    rest = rest.subspan(message.size());
  }
  return 0;
}
