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

/// Gathers a run from the events of a log, in their order. Of documents with one name the first counts, likewise of
/// true landmarks with one identity. Thread contract: thread-bound.
class RunCollector {
 public:
  /// `file` is what errors name; a rig may stand beside it.
  RunCollector(std::filesystem::path file, const LogOptions& options);

  /// What comes now is from the session's folder of images.
  void begin_frames() { in_frames_part_ = true; }

  /// `place` is where its data can be found again: images are not kept.
  void add(const LogEvent& event, const EventPlace& place = {});

  /// The run, if it has a rig, odometry, and, unless that alone is enough, bearings or frames.
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

  /// How far through a session's segments the reading has come, and what it missed.
  struct Segments {
    std::optional<std::uint64_t> current;
    std::uint64_t missing = 0, lost_events = 0;
  };

  /// How each sample of the run came.
  struct Arrivals {
    std::vector<Arrival> odometry, bearings, frames, truth;
  };

  std::filesystem::path file_;
  LogOptions options_;
  Run run_;
  Arrivals arrivals_;
  Arrival arrival_;                                    // of the event that is being added
  std::map<std::string, Holds, std::less<>> foreign_;  // channels of others
  std::map<std::string, std::string, std::less<>> documents_;
  std::unordered_set<Identity> true_identities_;
  Segments samples_, images_;
  bool in_frames_part_ = false, has_bot_poses_ = false;
};

/// `file` may be a session folder.
FileResult<Run> read_run_log(const std::filesystem::path& file, const LogOptions& options);

}  // namespace azimuth
