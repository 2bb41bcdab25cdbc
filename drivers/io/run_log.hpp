#pragma once
// Runs from LCM logs. Internal to drivers/io; see run.hpp.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "drivers/io/each_event.hpp"
#include "drivers/io/event_codec.hpp"
#include "drivers/io/run.hpp"

namespace azimuth {

/// Gathers a run from the events of a log, in their order. Of documents with one name the first counts, likewise of
/// true landmarks with one identity. Thread contract: thread-bound.
class RunCollector {
 public:
  /// `file` is what errors name; a rig may stand beside it.
  RunCollector(std::filesystem::path file, const LogOptions& options);

  /// `place` is where its data can be found again: images are not kept.
  void add(const LogEvent& event, const EventPlace& place = {});

  /// The run, if it has a rig, odometry, and bearings or frames.
  FileResult<Run> finish(std::uint64_t damaged_bytes) &&;

 private:
  void add_ours(std::string_view channel, Bytes data);
  void add_document(Bytes data);
  void add_image(Bytes data, const EventPlace& place);
  void add_mark(std::string_view text);
  void add_true_map(Bytes data);
  template <class Sample>
  void keep(std::optional<Sample> sample, std::vector<Sample>& samples);
  void use_tables();
  void put_in_order();
  void use_texts();
  void find_rig(FileErrors& errors);
  void check(FileErrors& errors) const;

  std::filesystem::path file_;
  std::string prefix_, image_channel_;
  Run run_;
  std::map<std::string, std::string, std::less<>> documents_;
  std::unordered_set<Identity> true_identities_;
  std::optional<std::uint64_t> segment_;  // the one being read
};

/// `file` may be a session folder.
FileResult<Run> read_run_log(const std::filesystem::path& file, const LogOptions& options);

}  // namespace azimuth
