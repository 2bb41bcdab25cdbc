// A valid log whose documents hold any bytes: rig, configuration, kept odometry, tables, map, segment marks. Catalogue
// and replay must read values or report violations.
//
// The first byte of the input selects the document; the second tells whether the next one follows after a zero byte.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include "drivers/storage/kept_odometry.hpp"
#include "drivers/storage/map_codec.hpp"
#include "drivers/storage/run_folder.hpp"
#include "drivers/storage/run_log.hpp"
#include "drivers/storage/session.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/event_codec.hpp"
#include "drivers/wire/messages.hpp"
#include "settings/configuration.hpp"
#include "settings/rig.hpp"

namespace azimuth {
namespace {

const std::array<std::string, 8> kNames{kRigFile,         kConfigurationDocument, kOdometryDocument, kMapDocument,
                                        kVersionDocument, kSegmentDocument,       kFramesFile,       kLandmarksFile};

void require(bool condition) {
  if (!condition) std::abort();
}

template <class Message>
void append(std::vector<std::byte>& log, std::string_view channel, const Message& message) {
  std::vector<std::byte> data;
  encode(message, data);
  append_event(log, {0, message.utime, channel, data});
}

std::vector<std::byte> log_with(std::string_view documents) {
  std::vector<std::byte> log;
  while (documents.size() >= 2) {
    const std::string& name = kNames[static_cast<unsigned char>(documents[0]) % kNames.size()];
    const bool goes_on = documents[1] != '\0';
    documents.remove_prefix(2);
    const std::size_t size = goes_on ? std::min(documents.find('\0'), documents.size()) : documents.size();
    append(log, channel::kDocument, to_message(name, std::string(documents.substr(0, size)), stamp_from_us(1)));
    documents.remove_prefix(std::min(size + 1, documents.size()));
  }
  for (std::int64_t i = 1; i <= 2; ++i) {
    OdometryReading reading;
    reading.stamp = stamp_from_us(i * 1'000'000);
    append(log, channel::kOdometry, to_message(reading));
  }
  return log;
}

void check(std::string_view documents) {
  const std::vector<std::byte> log = log_with(documents);
  RunCollector collector("fuzz.lcmlog", {.odometry_alone = true, .rig_may_come_later = true});
  EventScanner scanner(log);
  while (const auto event = scanner.next()) collector.add(*event, {"fuzz.lcmlog", 0});
  require(scanner.damaged_bytes() == 0);
  const FileResult<Run> run = std::move(collector).finish(0);
  require(run.has_value());
  if (const FileResult<Rig> rig = read_rig(run->rig_toml, run->rig_file); !rig) require(!text(rig.error()).empty());
  static_cast<void>(read_configuration(run->configuration_toml, run->configuration_file));
  MapSnapshot map;
  static_cast<void>(decode_map(std::as_bytes(std::span(run->map)), map));
}

}  // namespace
}  // namespace azimuth

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  azimuth::check({reinterpret_cast<const char*>(data), size});
  return 0;
}
