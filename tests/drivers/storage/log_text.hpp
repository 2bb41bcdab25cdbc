#pragma once
// Logs built event by event, and the runs collected from them.

#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "drivers/storage/event_log.hpp"
#include "drivers/storage/run_log.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/messages.hpp"
#include "tests/drivers/wire/samples.hpp"

namespace azimuth::test {

/// Builds a log event by event.
class LogText {
 public:
  template <class Message>
  LogText& add(std::string_view channel, const Message& message) {
    Buffer data;
    encode(message, data);
    return add(channel, data);
  }
  LogText& add(std::string_view channel, const Buffer& data) {
    append_event(bytes_, {number_++, recorded_us_, channel, data});
    return *this;
  }
  /// Sets the recording time of all events added later.
  LogText& recorded_at(std::int64_t utime_us) {
    recorded_us_ = utime_us;
    return *this;
  }
  LogText& odometry(std::int64_t utime_us) {
    return add(channel::kOdometry, to_message(OdometryReading{stamp_from_us(utime_us), 0, 0, {}}));
  }
  LogText& bearings(std::int64_t utime_us) {
    return add(channel::kBearings, to_message(BearingSet{stamp_from_us(utime_us), 0, {{}}}));
  }
  LogText& rig() { return add(channel::kDocument, to_message("rig.toml", "x = 1\n", Stamp{})); }

  const Buffer& bytes() const { return bytes_; }

 private:
  Buffer bytes_;
  std::int64_t number_ = 0, recorded_us_ = 0;
};

inline FileResult<Run> collect(Bytes log, const LogOptions& options = {}) {
  RunCollector collector("/nowhere/drive.lcm", options);
  EventScanner scanner(log);
  while (const auto event = scanner.next()) collector.add(*event);
  return std::move(collector).finish(scanner.damaged_bytes());
}

inline Run collected(const LogText& log, const LogOptions& options = {}) {
  auto run = collect(log.bytes(), options);
  if (!run) throw std::runtime_error(text(run.error()));
  return *std::move(run);
}

}  // namespace azimuth::test
