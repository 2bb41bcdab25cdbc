// Uses the C interface of the journal, because a sink of the logging library cannot set fields.
#define SD_JOURNAL_SUPPRESS_LOCATION
#include "daemon/journal/journal.hpp"

#include <array>
#include <atomic>
#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <sys/uio.h>
#include <syslog.h>
#include <systemd/sd-journal.h>

#include "base/visible.hpp"

namespace azimuth {
namespace {

using Level = spdlog::level::level_enum;

struct KindOfEvent {
  const char* name;  ///< field AZIMUTH_EVENT
  const char* id;    ///< field MESSAGE_ID
  Level level;
};

/// In the order of JournalEvent.
constexpr std::array kKinds{
    KindOfEvent{"device_trouble", "58a3ae07fbb14cbe992a1f5a621e0a17", Level::warn},
    KindOfEvent{"device_recovered", "60d6dd9c94724e7bba376c8c12d4ae24", Level::info},
    KindOfEvent{"port_reset", "72b28cce04784d8f921da08d5538edae", Level::warn},
    KindOfEvent{"stage_late", "28e3f670a8854c91bf99e4e844d2599a", Level::err},
    KindOfEvent{"stage_goes_on", "bb40b70532ad443abdb01041dfd9a6f6", Level::info},
    KindOfEvent{"map_loaded", "871ce46d52a24824a1ce85992bc4cd09", Level::info},
    KindOfEvent{"map_saved", "bc69478363334d52a98a11e715be81f1", Level::info},
    KindOfEvent{"map_trouble", "e5a743437ae943068996d7b6962eabda", Level::warn},
    KindOfEvent{"configuration_refused", "1f14d083a2714cd6a5581f4a82ea796a", Level::err},
    KindOfEvent{"configuration_reloaded", "b536fe05f7cb4373add759999f0afa4d", Level::info},
    KindOfEvent{"realtime_refused", "ee5a423ad9bf433192333387dc1e04a7", Level::warn},
    KindOfEvent{"sample_trouble", "7c2f0be1a94d4f0c8a5d61e3b7f94c58", Level::warn},
};
static_assert(kKinds.size() == static_cast<std::size_t>(JournalEvent::sample_trouble) + 1);

std::atomic<bool> to_journal{false};

const KindOfEvent& kind_of(JournalEvent event) { return kKinds[static_cast<std::size_t>(event)]; }

int priority(Level level) {
  if (level >= Level::err) return LOG_ERR;
  return level == Level::warn ? LOG_WARNING : LOG_INFO;
}

bool send(std::vector<std::string> fields) {
  std::vector<iovec> pieces;
  pieces.reserve(fields.size());
  for (std::string& field : fields) pieces.push_back({field.data(), field.size()});
  return sd_journal_sendv(pieces.data(), static_cast<int>(pieces.size())) == 0;
}

}  // namespace

std::vector<std::string> journal_fields(JournalEvent event, std::string_view text, const JournalSubject& subject) {
  const KindOfEvent& kind = kind_of(event);
  std::vector<std::string> fields{fmt::format("MESSAGE={}", visible(text)),
                                  fmt::format("PRIORITY={}", priority(kind.level)), "SYSLOG_IDENTIFIER=azimuthd",
                                  fmt::format("MESSAGE_ID={}", kind.id), fmt::format("AZIMUTH_EVENT={}", kind.name)};
  if (!subject.device.empty()) fields.push_back(fmt::format("AZIMUTH_DEVICE={}", subject.device));
  if (!subject.stage.empty()) fields.push_back(fmt::format("AZIMUTH_STAGE={}", subject.stage));
  return fields;
}

void log_event(JournalEvent event, std::string_view text, const JournalSubject& subject) {
  const Level level = kind_of(event).level;
  if (!spdlog::should_log(level)) return;
  if (to_journal.load(std::memory_order_relaxed) && send(journal_fields(event, text, subject))) return;
  spdlog::log(level, "{}", text);
}

void log_to_journal(bool yes) { to_journal.store(yes, std::memory_order_relaxed); }

}  // namespace azimuth
