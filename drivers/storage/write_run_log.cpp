#include <algorithm>
#include <cmath>

#include "drivers/storage/event_log.hpp"
#include "drivers/storage/frame_reader.hpp"
#include "drivers/storage/run.hpp"
#include "drivers/storage/run_folder.hpp"
#include "drivers/storage/tables.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/image_header.hpp"
#include "drivers/wire/image_message.hpp"
#include "drivers/wire/messages.hpp"

namespace azimuth {

namespace {

/// Writes messages as events at their own times. Stops at the first error.
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

void write_documents(MessageLog& log, const Run& run) {
  const Stamp stamp = first_stamp(run);
  const auto has_kind = [](const TrueLandmark& landmark) { return !landmark.kind.empty(); };
  log.write_document(kRigFile, run.rig_toml, stamp);
  if (run.landmarks.empty()) return;
  for (const map_chunk_t& chunk : to_messages(run.landmarks, stamp)) log.write(channel::kTruthMap, chunk);
  if (std::ranges::any_of(run.landmarks, has_kind)) {  // a map message cannot hold kinds
    log.write_document(kLandmarksFile, landmarks_table(run.landmarks), stamp);
  }
}

/// Writes frames one at a time.
class ImageLog {
 public:
  ImageLog(MessageLog& log, const Run& run, std::string_view channel)
      : log_(log), reader_(run.folder), channel_(channel) {}

  void write(const FrameFile& frame) {
    const ImageView image = reader_.read(frame);
    if (is_png(image.bytes) && !frame.part && png_.empty()) png_ = frame.file;
    fill_message(image, frame.stamp, message_);
    log_.write(channel_, message_);
  }

  /// The first image in a format that messages do not have; empty: there was none.
  const std::string& png() const { return png_; }

 private:
  MessageLog& log_;
  FrameReader reader_;
  std::string channel_, png_;
  image_t message_{};
};

/// How many records of one kind have been written.
template <class Record>
struct Progress {
  const std::vector<Record>& records;
  std::size_t next = 0;

  Stamp stamp() const { return next < records.size() ? records[next].stamp : Stamp::max(); }
  bool done() const { return next == records.size(); }
};

void write_samples(MessageLog& log, ImageLog& images, const Run& run, const WriteProgress& progress) {
  Progress<OdometryReading> odometry{run.odometry};
  Progress<FrameFile> frames{run.frames};
  Progress<BearingSet> bearings{run.bearings};
  Progress<TruthPose> truth{run.truth};
  const std::size_t all = run.odometry.size() + run.frames.size() + run.bearings.size() + run.truth.size();
  while (!odometry.done() || !frames.done() || !bearings.done() || !truth.done()) {
    if (progress) progress(odometry.next + frames.next + bearings.next + truth.next, all);
    const Stamp next = std::min({odometry.stamp(), frames.stamp(), bearings.stamp(), truth.stamp()});
    if (odometry.stamp() == next) {
      log.write(channel::kOdometry, to_message(run.odometry[odometry.next++]));
    } else if (frames.stamp() == next) {
      images.write(run.frames[frames.next++]);
    } else if (bearings.stamp() == next) {
      log.write_bearings(run.bearings[bearings.next++]);
    } else {
      log.write(channel::kTruth, to_message(run.truth[truth.next], static_cast<std::int64_t>(truth.next)));
      ++truth.next;
    }
  }
}

}  // namespace

FileResult<void> write_run_log(const Run& run, const std::filesystem::path& file, const LogOptions& options,
                               const WriteProgress& progress) {
  const auto is_unknown = [](const TruthPose& truth) { return std::isnan(truth.T_world_body.heading_rad); };
  if (std::ranges::any_of(run.truth, is_unknown))
    return failure(FileError{file.string(), 0, "a log cannot hold truth without heading; a run folder can"});
  FileResult<EventLogWriter> writer = EventLogWriter::create(file);
  if (!writer) return failure(writer.error());
  MessageLog log(*writer, options.channel_prefix);
  write_documents(log, run);
  ImageLog images(log, run, options.image_channel);
  write_samples(log, images, run, progress);
  if (!images.png().empty())
    return failure(FileError{(run.folder / images.png()).string(), 0, "is a PNG image, which a log cannot hold"});
  if (const std::error_code error = log.finish()) {
    return failure(FileError{file.string(), 0, "cannot be written: " + error.message()});
  }
  return {};
}

FileResult<void> write_run_log(const Run& run, const std::filesystem::path& file, const LogOptions& options) {
  return write_run_log(run, file, options, {});
}

}  // namespace azimuth
