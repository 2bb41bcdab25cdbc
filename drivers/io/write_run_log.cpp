#include <algorithm>

#include "drivers/io/channels.hpp"
#include "drivers/io/event_log.hpp"
#include "drivers/io/messages.hpp"
#include "drivers/io/run.hpp"
#include "drivers/io/run_folder.hpp"
#include "drivers/io/tables.hpp"

namespace azimuth {

namespace {

/// Writes messages as events of their own instants; the first error ends it.
class MessageLog {
 public:
  MessageLog(EventLogWriter& log, std::string prefix) : log_(log), prefix_(std::move(prefix)) {}

  template <class Message>
  void write(std::string_view channel, const Message& message) {
    if (error_) return;
    encode(message, data_);
    error_ = log_.write(message.utime, prefix_ + std::string(channel), data_);
  }

  void write_bearings(const BearingSet& set) {
    if (is_plain(set)) return write(channel::kBearings, to_message(set));
    write(channel::kFeatures, to_features_message(set));
  }

  void write_document(const char* name, const std::string& text, Stamp stamp) {
    write(channel::kDocument, to_message(name, text, stamp));
  }

  std::error_code finish() { return error_ ? error_ : log_.flush(); }

 private:
  EventLogWriter& log_;
  std::string prefix_;
  std::vector<std::byte> data_;
  std::error_code error_;
};

Stamp first_stamp(const Run& run) {
  Stamp first = Stamp::max();
  const auto include = [&first](const auto& records) {
    if (!records.empty()) first = std::min(first, records.front().stamp);
  };
  include(run.odometry);
  include(run.bearings);
  include(run.truth);
  return first == Stamp::max() ? Stamp{} : first;
}

void write_documents(MessageLog& log, const Run& run) {
  const Stamp stamp = first_stamp(run);
  const auto has_kind = [](const TrueLandmark& landmark) { return !landmark.kind.empty(); };
  log.write_document(kRigFile, run.rig_toml, stamp);
  if (!run.frames.empty()) log.write_document(kFramesFile, frames_table(run.frames), stamp);
  if (run.landmarks.empty()) return;
  for (const map_chunk_t& chunk : to_messages(run.landmarks, stamp)) log.write(channel::kTruthMap, chunk);
  if (std::ranges::any_of(run.landmarks, has_kind)) {  // which a map message cannot say
    log.write_document(kLandmarksFile, landmarks_table(run.landmarks), stamp);
  }
}

void write_samples(MessageLog& log, const Run& run) {
  std::size_t odometry = 0, bearings = 0, truth = 0;
  const auto stamp_at = [](const auto& records, std::size_t i) {
    return i < records.size() ? records[i].stamp : Stamp::max();
  };
  while (odometry < run.odometry.size() || bearings < run.bearings.size() || truth < run.truth.size()) {
    const Stamp next_odometry = stamp_at(run.odometry, odometry);
    const Stamp next_bearings = stamp_at(run.bearings, bearings);
    const Stamp next_truth = stamp_at(run.truth, truth);
    if (next_odometry <= next_bearings && next_odometry <= next_truth) {
      log.write(channel::kOdometry, to_message(run.odometry[odometry++]));
    } else if (next_bearings <= next_truth) {
      log.write_bearings(run.bearings[bearings++]);
    } else {
      log.write(channel::kTruth, to_message(run.truth[truth], static_cast<std::int64_t>(truth)));
      ++truth;
    }
  }
}

}  // namespace

std::optional<FileError> write_run_log(const Run& run, const std::filesystem::path& file, const LogOptions& options) {
  FileResult<EventLogWriter> writer = EventLogWriter::create(file);
  if (!writer) return writer.errors().front();
  MessageLog log(*writer, options.channel_prefix);
  write_documents(log, run);
  write_samples(log, run);
  if (const std::error_code error = log.finish()) {
    return FileError{file.string(), 0, "cannot be written: " + error.message()};
  }
  return std::nullopt;
}

}  // namespace azimuth
