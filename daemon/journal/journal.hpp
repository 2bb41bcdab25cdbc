#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace azimuth {

/// The daemon's events that users may want to find again or be notified of. Each has an identifier in the journal, and
/// an explanation in the journal's catalogue (packaging/systemd/azimuth.catalog).
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

/// The subject of an event. An empty field does not apply.
struct JournalSubject {
  std::string_view device = {};  ///< "odometer", "camera"
  std::string_view stage = {};   ///< name of the stage's thread
};

/// Logs `text` with the severity of `event`. After log_to_journal(true) the event goes to the journal, with the
/// fields MESSAGE_ID, AZIMUTH_EVENT, AZIMUTH_DEVICE and AZIMUTH_STAGE. Otherwise, or when the journal does not accept
/// the event, the text is logged like any other line.
///
/// Thread-safe. Allocates, so it is not for real-time threads.
void log_event(JournalEvent event, std::string_view text, const JournalSubject& subject = {});

/// Selects whether events go to the journal with their fields.
void log_to_journal(bool yes);

/// The fields of an event in the form "MESSAGE=...", for sd_journal_sendv(3).
std::vector<std::string> journal_fields(JournalEvent event, std::string_view text, const JournalSubject& subject);

}  // namespace azimuth
