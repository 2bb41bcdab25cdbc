#pragma once
// A session: the folder into which the daemon records from one start. It consists of segments 000.lcm, 001.lcm and so
// on. Each segment is an LCM log that begins with the documents of the recording, so that it can be replayed alone.
// Recorded images lie in segments of their own in the folder frames, which may be deleted without harm to the rest.
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

/// The number in a segment's file name; none for any other name.
std::optional<std::uint64_t> segment_number(std::string_view name);

/// One segment on disk.
struct SegmentFile {
  std::uint64_t number = 0;
  std::filesystem::path file;
};

/// The segments in a folder in order; empty when there are none, or the folder cannot be read.
std::vector<SegmentFile> session_segments(const std::filesystem::path& folder);

/// The document `segment`, the first in each segment: the position of the segment in its session.
struct SegmentMark {
  /// From 0. A number above 0 means that the estimator's start is not in this segment.
  std::uint64_t number = 0;
  /// Events of the session before this segment that are in no segment, because the disk was full.
  std::uint64_t lost_events = 0;
  friend bool operator==(const SegmentMark&, const SegmentMark&) = default;
};

/// The folder of a session that holds its images.
inline constexpr const char* kFramesPart = "frames";

/// A text, or bytes, that belong to a recording.
struct Document {
  std::string name;  ///< file name without a folder, such as "rig.toml"
  std::string text;
  bool of_the_start = false;  ///< belongs only to the first segment of a session
};

// The names of the documents in a daemon's recording, in addition to rig.toml.
inline constexpr const char* kSegmentDocument = "segment";
inline constexpr const char* kConfigurationDocument = "azimuth.toml";  ///< the estimator's configuration
inline constexpr const char* kMapDocument = "map.azmap";               ///< the map that the estimator started from
inline constexpr const char* kOdometryDocument = "odometry";           ///< the motion of the robot since that map
inline constexpr const char* kVersionDocument = "version";             ///< version of the daemon

/// Two lines of TOML.
std::string to_text(const SegmentMark& mark);

/// Parses exactly the output of to_text().
std::optional<SegmentMark> parse_segment_mark(std::string_view text);

}  // namespace azimuth
