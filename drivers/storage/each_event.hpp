#pragma once
// Internal to drivers/storage.

#include <cstdint>
#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

#include "drivers/storage/event_log.hpp"
#include "drivers/storage/session.hpp"

namespace azimuth {

struct EventTotals {
  std::uint64_t events = 0;
  std::uint64_t damaged_bytes = 0;
};

/// The files of a recording. For a log these are the log itself and the numbered logs that may continue it (lcm-logger
/// --split-mb: drive.lcm.00, drive.lcm.01); for a session folder, its segments in order.
std::vector<std::filesystem::path> log_files(const std::filesystem::path& log_or_session);

/// A sentence for a person about the contents of a file that holds no complete event.
std::string no_log(const std::filesystem::path& file);

/// True: a numbered log continues where the previous one ended. The next recording of the same day may have the next
/// number, but does not continue it.
constexpr bool goes_on(std::int64_t last_us, std::int64_t first_us) {
  return first_us >= last_us - 1'000'000 && first_us <= last_us + 5'000'000;
}

/// The position of an event's data.
struct EventPlace {
  std::filesystem::path file;
  std::uint64_t offset = 0;
};

/// Calls `use(event)` or `use(event, place)` for each complete event of a log or session.
template <class Use>
FileResult<EventTotals> each_event(const std::filesystem::path& log_or_session, Use use) {
  EventTotals totals;
  std::error_code ignored;
  const bool is_session = std::filesystem::is_directory(log_or_session, ignored);
  std::int64_t last_us = 0;
  for (const std::filesystem::path& file : log_files(log_or_session)) {
    FileResult<EventLogReader> log = EventLogReader::open(file);
    // A running daemon may have deleted a segment since the folder was listed.
    if (!log && file != log_or_session && !std::filesystem::exists(file, ignored)) continue;
    if (!log) return failure(log.error());
    bool is_first = file != log_or_session && !is_session;
    for (; const std::optional<LogEvent> event = log->next(); ++totals.events) {
      if (is_first && !goes_on(last_us, event->utime_us)) return totals;
      is_first = false;
      last_us = event->utime_us;
      if constexpr (std::is_invocable_v<Use&, const LogEvent&, const EventPlace&>) {
        use(*event, EventPlace{file, log->offset_of(*event)});
      } else {
        use(*event);
      }
    }
    totals.damaged_bytes += log->damaged_bytes();
  }
  if (totals.events == 0) return failure(FileError{log_or_session.string(), 0, no_log(log_or_session)});
  return totals;
}

}  // namespace azimuth
