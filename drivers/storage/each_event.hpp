#pragma once
// Internal to drivers/storage.

#include <cstdint>
#include <filesystem>
#include <type_traits>
#include <vector>

#include "drivers/storage/event_log.hpp"
#include "drivers/storage/session.hpp"

namespace azimuth {

struct EventTotals {
  std::uint64_t events = 0;
  std::uint64_t damaged_bytes = 0;
};

/// The files of a recording: the log itself, or the segments of a session folder in their order.
inline std::vector<std::filesystem::path> log_files(const std::filesystem::path& log_or_session) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(log_or_session, ignored)) return {log_or_session};
  std::vector<std::filesystem::path> files;
  for (SegmentFile& segment : session_segments(log_or_session)) files.push_back(std::move(segment.file));
  return files;
}

/// Where the data of an event lies.
struct EventPlace {
  std::filesystem::path file;
  std::uint64_t offset = 0;
};

/// Calls `use(event)`, or `use(event, place)`, for each whole event of a log or session.
template <class Use>
FileResult<EventTotals> each_event(const std::filesystem::path& log_or_session, Use use) {
  EventTotals totals;
  for (const std::filesystem::path& file : log_files(log_or_session)) {
    FileResult<EventLogReader> log = EventLogReader::open(file);
    // A daemon at work may have deleted a segment since the folder was listed.
    std::error_code ignored;
    if (!log && file != log_or_session && !std::filesystem::exists(file, ignored)) continue;
    if (!log) return failure(log.error());
    for (; const std::optional<LogEvent> event = log->next(); ++totals.events) {
      if constexpr (std::is_invocable_v<Use&, const LogEvent&, const EventPlace&>) {
        use(*event, EventPlace{file, log->offset_of(*event)});
      } else {
        use(*event);
      }
    }
    totals.damaged_bytes += log->damaged_bytes();
  }
  if (totals.events == 0)
    return failure(FileError{log_or_session.string(), 0, "is not an LCM log: it holds no whole event"});
  return totals;
}

}  // namespace azimuth
