// Any bytes as an LCM log. Events must be within bounds, every byte must belong to an event or be counted, and the
// resulting run must be valid.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>

#include "drivers/storage/run_log.hpp"
#include "drivers/wire/plausible.hpp"

namespace azimuth {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

template <class Record>
void require_in_order(const std::vector<Record>& records) {
  const auto not_after = [](const Record& a, const Record& b) { return b.stamp <= a.stamp; };
  require(std::ranges::adjacent_find(records, not_after) == records.end());
}

void require_sound(const Run& run) {
  require(!run.odometry.empty());
  require_in_order(run.odometry);
  require_in_order(run.bearings);
  require_in_order(run.truth);
  require_in_order(run.frames);
  for (const auto& reading : run.odometry) require(is_plausible(reading.T_odom_body));
  for (const auto& pose : run.truth) require(is_plausible(pose.T_world_body));
  for (const auto& set : run.bearings) {
    for (const auto& bearing : set.bearings) require(is_plausible(bearing) && bearing.azimuth_rad < kPi);
    require(set.descriptors.empty() || set.descriptors.size() == set.bearings.size());
    require(set.neighbours.empty() || set.neighbours.size() == set.bearings.size());
    for (const auto& neighbours : set.neighbours)
      for (const auto index : neighbours.index) require(index == Neighbours::kNone || index < set.bearings.size());
  }
}

/// Images must lie within the log, and uncompressed ones must have their stated size.
void require_images_within(const Run& run, Bytes log) {
  for (const FrameFile& frame : run.frames) {
    if (!frame.part || frame.part->size == 0) continue;
    require(frame.part->offset <= log.size() && frame.part->size <= log.size() - frame.part->offset);
    const Bytes bytes = log.subspan(frame.part->offset, frame.part->size);
    require(frame.part->format.pixels == PixelFormat::mjpeg || ImageView{frame.part->format, bytes}.readable());
  }
}

void check_log(Bytes log, const LogOptions& options) {
  EventScanner scanner(log);
  RunCollector collector("fuzz.lcm", options);
  std::uint64_t event_bytes = 0;
  while (const auto event = scanner.next()) {
    require(!event->channel.empty() && event->channel.size() <= kMaxChannelLength);
    event_bytes += kEventHeaderSize + event->channel.size() + event->data.size();
    collector.add(*event, {"fuzz.lcm", static_cast<std::uint64_t>(event->data.data() - log.data())});
  }
  require(event_bytes + scanner.damaged_bytes() == log.size());
  if (const auto run = std::move(collector).finish(scanner.damaged_bytes())) {
    require_sound(*run);
    require_images_within(*run, log);
  }
}

}  // namespace
}  // namespace azimuth

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const azimuth::Bytes log(reinterpret_cast<const std::byte*>(data), size);
  azimuth::check_log(log, {});
  azimuth::check_log(log, {.odometry_channel = "POSE", .odometry_alone = true});
  return 0;
}
