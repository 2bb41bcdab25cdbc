#pragma once
// Runs from LCM logs. Internal to drivers/storage; see run.hpp.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "drivers/storage/clock_jumps.hpp"
#include "drivers/storage/each_event.hpp"
#include "drivers/storage/run.hpp"
#include "drivers/wire/event_codec.hpp"

namespace azimuth {

/// Collects a run from the events of a log in their order. Of documents with the same name, and of true landmarks with
/// the same identity, the first one is used. Thread contract: thread-bound.
class RunCollector {
 public:
  /// `file` is the name in errors; a rig may lie beside it.
  RunCollector(std::filesystem::path file, const LogOptions& options);

  /// Tells that the following events come from the session's folder of images.
  void begin_frames() { in_frames_part_ = true; }

  /// `place` is the position of the event's data, because images are not kept in memory.
  void add(const LogEvent& event, const EventPlace& place = {});

  /// The run, provided that it has a rig, odometry and bearings or frames. LogOptions can make some of these optional.
  FileResult<Run> finish(std::uint64_t damaged_bytes) &&;

 private:
  bool is_on(std::string_view channel, const std::string& name) const;
  void add_foreign_odometry(Bytes data);
  void add_foreign(std::string_view channel, Bytes data);
  void add_ours(std::string_view channel, Bytes data);
  void add_document(Bytes data);
  void add_image(Bytes data, const EventPlace& place);
  void add_mark(std::string_view text);
  void add_true_map(Bytes data);
  template <class Sample>
  void keep(std::optional<Sample> sample, std::vector<Sample>& samples, std::vector<Arrival>& arrivals);
  void use_tables();
  void mend_clock();
  void put_in_order();
  void use_texts();
  void account();
  void find_rig(FileErrors& errors);
  void use_rig(const std::filesystem::path& file, FileErrors& errors);
  bool sees_anything() const { return !run_.bearings.empty() || !run_.frames.empty(); }
  void check(FileErrors& errors) const;

  enum class Holds : std::uint8_t { odometry, images, other };
  std::string meant(Holds what, std::string_view option) const;

  /// The progress through a session's segments, and the missing data.
  struct Segments {
    std::optional<std::uint64_t> current;
    std::uint64_t missing = 0, lost_events = 0;
  };

  /// The arrival of each sample of the run.
  struct Arrivals {
    std::vector<Arrival> odometry, bearings, frames, truth;
  };

  std::filesystem::path file_;
  LogOptions options_;
  Run run_;
  Arrivals arrivals_;
  Arrival arrival_;                                    // arrival of the event that is being added
  std::map<std::string, Holds, std::less<>> foreign_;  // channels of other programs
  std::map<std::string, std::string, std::less<>> documents_;
  std::unordered_set<Identity> true_identities_;
  Segments samples_, images_;
  bool in_frames_part_ = false, has_bot_poses_ = false;
};

/// `file` may also be a session folder.
FileResult<Run> read_run_log(const std::filesystem::path& file, const LogOptions& options);

}  // namespace azimuth
