#pragma once
// A session: the folder one start of the daemon records into, cut into segments 000.lcm, 001.lcm and so on. Each
// segment is an LCM log that begins with the documents of the recording, so that it can be replayed by itself. Images
// that were recorded as well lie in segments of their own in the folder frames, which may be deleted without harm to
// the rest.
//
// Thread contract: reentrant.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace azimuth {

/// "000.lcm"; more digits from 1000 on.
std::string segment_name(std::uint64_t number);

/// The number in a segment's file name; nothing for any other name.
std::optional<std::uint64_t> segment_number(std::string_view name);

/// One segment on disk.
struct SegmentFile {
  std::uint64_t number = 0;
  std::filesystem::path file;
};

/// The segments in a folder, in their order. None when it has none, or is not a folder that can be read.
std::vector<SegmentFile> session_segments(const std::filesystem::path& folder);

/// The document `segment`, first in each: which part of its session a segment is.
struct SegmentMark {
  std::uint64_t number = 0;  ///< from 0; a higher one says that estimates do not begin with this segment
  std::uint64_t lost_events =
      0;  ///< events of the session before this segment that no segment holds: the disk was full
  friend bool operator==(const SegmentMark&, const SegmentMark&) = default;
};

/// The folder of a session in which its images lie.
inline constexpr const char* kFramesPart = "frames";

/// A text, or bytes, that belong to a recording.
struct Document {
  std::string name;  ///< file name without a folder, such as "rig.toml"
  std::string text;
  bool of_the_start = false;  ///< belongs to the first segment of a session only
};

// The names of documents in a daemon's recording, beside rig.toml.
inline constexpr const char* kSegmentDocument = "segment";
inline constexpr const char* kConfigurationDocument = "azimuth.toml";  ///< what the estimator was told
inline constexpr const char* kMapDocument = "map.azmap";               ///< what the estimator started from
inline constexpr const char* kOdometryDocument = "odometry";           ///< and how the robot had gone on from there
inline constexpr const char* kVersionDocument = "version";             ///< of the daemon

/// Two lines of TOML.
std::string to_text(const SegmentMark& mark);

/// Reads exactly what to_text() writes.
std::optional<SegmentMark> parse_segment_mark(std::string_view text);

}  // namespace azimuth
