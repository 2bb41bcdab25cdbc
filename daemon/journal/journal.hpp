#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace azimuth {

/// What happens to a daemon that somebody may want to find again, or be told about: each has an identifier in the
/// journal, and an explanation in its catalogue (systemd/azimuth.catalog).
enum class JournalEvent {
  device_trouble,
  device_recovered,
  port_reset,
  stage_late,
  stage_goes_on,
  map_loaded,
  map_saved,
  map_trouble,
  configuration_refused,
  configuration_reloaded,
  realtime_refused,
  sample_trouble
};

/// What an event is about; empty: nothing of that kind.
struct JournalSubject {
  std::string_view device = {};  ///< "odometer", "camera"
  std::string_view stage = {};   ///< a thread's name
};

/// Logs `text` with the severity of `event`: to the journal with the fields MESSAGE_ID, AZIMUTH_EVENT, AZIMUTH_DEVICE
/// and AZIMUTH_STAGE when log_to_journal() says so, else (or when the journal does not take it) as any other line.
///
/// Thread-safe. Allocates: not for real-time threads.
void log_event(JournalEvent event, std::string_view text, const JournalSubject& subject = {});

/// Events go to the journal with their fields from now on, or not any more.
void log_to_journal(bool yes);

/// The fields of an event, as sd_journal_sendv(3) takes them: "MESSAGE=...".
std::vector<std::string> journal_fields(JournalEvent event, std::string_view text, const JournalSubject& subject);

}  // namespace azimuth
