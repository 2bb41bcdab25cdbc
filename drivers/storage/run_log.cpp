#include "drivers/storage/run_log.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <utility>

#include "base/files.hpp"
#include "drivers/storage/in_order.hpp"
#include "drivers/storage/kept_odometry.hpp"
#include "drivers/storage/run_folder.hpp"
#include "drivers/storage/session.hpp"
#include "drivers/storage/tables.hpp"
#include "drivers/wire/bot_odometry.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/image_message.hpp"
#include "drivers/wire/messages.hpp"

namespace azimuth {

namespace fs = std::filesystem;

namespace {

constexpr std::array kOutputs{channel::kPose,      channel::kBotPose,  channel::kMapChunk,
                              channel::kPath,      channel::kStatus,   channel::kPicture,
                              channel::kSightings, channel::kExpected, channel::kKept};

/// The rig file beside a log, e.g. drive.rig.toml for drive.lcm.
fs::path rig_beside(const fs::path& log) { return fs::path(log).replace_extension(".rig.toml"); }

}  // namespace

RunCollector::RunCollector(fs::path file, const LogOptions& options) : file_(std::move(file)), options_(options) {
  std::error_code ignored;  // a wrong name is reported later
  run_.name = fs::weakly_canonical(file_, ignored).stem().string();
  run_.folder = file_.parent_path();
}

void RunCollector::add(const LogEvent& event, const EventPlace& place) {
  ++arrival_.place;
  arrival_.recorded = stamp_from_us(event.utime_us);
  if (is_on(event.channel, options_.image_channel) && claims_image(event.data)) {
    add_image(event.data, place);
  } else if (!options_.odometry_channel.empty() && is_on(event.channel, options_.odometry_channel)) {
    add_foreign_odometry(event.data);
  } else if (event.channel.starts_with(options_.channel_prefix)) {
    add_ours(event.channel.substr(options_.channel_prefix.size()), event.data);
  } else {
    add_foreign(event.channel, event.data);
  }
}

/// Counts a foreign event. Remembers the likely contents of each channel by its first message, for hints to a user who
/// has not named the channels.
void RunCollector::add_foreign(std::string_view channel, Bytes data) {
  ++run_.skipped.foreign_events;
  constexpr std::size_t kMostRemembered = 20;
  const bool ours_with_another_prefix = channel.ends_with(channel::kOdometry);
  if (ours_with_another_prefix || foreign_.size() == kMostRemembered || foreign_.contains(channel)) return;
  const bool is_odometry = decode_odometry(data) || decode_bot_odometry(data);
  foreign_.emplace(channel, is_odometry ? Holds::odometry : claims_image(data) ? Holds::images : Holds::other);
}

/// True: the channel has this name, with or without the prefix, because other programs do not use the prefix.
bool RunCollector::is_on(std::string_view channel, const std::string& name) const {
  return channel == name || channel == options_.channel_prefix + name;
}

void RunCollector::add_foreign_odometry(Bytes data) {
  if (auto reading = decode_odometry(data)) return keep(std::move(reading), run_.odometry, arrivals_.odometry);
  auto pose = decode_bot_odometry(data);
  has_bot_poses_ = has_bot_poses_ || pose;
  keep(std::move(pose), run_.odometry, arrivals_.odometry);
}

void RunCollector::add_ours(std::string_view channel, Bytes data) {
  if (channel == channel::kOdometry) {
    if (options_.odometry_channel.empty()) keep(decode_odometry(data), run_.odometry, arrivals_.odometry);
  } else if (channel == channel::kBearings) {
    keep(decode_bearings(data), run_.bearings, arrivals_.bearings);
  } else if (channel == channel::kFeatures) {
    keep(decode_features(data), run_.bearings, arrivals_.bearings);
  } else if (channel == channel::kTruth) {
    keep(decode_truth(data), run_.truth, arrivals_.truth);
  } else if (channel == channel::kTruthMap) {
    add_true_map(data);
  } else if (channel == channel::kDocument) {
    add_document(data);
  } else if (std::ranges::count(kOutputs, channel) > 0) {
    ++run_.skipped.output_events;
  } else {
    add_foreign(channel, data);
  }
}

template <class Sample>
void RunCollector::keep(std::optional<Sample> sample, std::vector<Sample>& samples, std::vector<Arrival>& arrivals) {
  if (sample) {
    samples.push_back(*std::move(sample));
    arrivals.push_back(arrival_);
  } else {
    ++run_.skipped.malformed_messages;
  }
}

void RunCollector::add_document(Bytes data) {
  if (auto document = decode_document(data)) {
    if (document->name == kSegmentDocument)
      return add_mark({reinterpret_cast<const char*>(document->data.data()), document->data.size()});
    documents_.try_emplace(std::move(document->name), document->data.begin(), document->data.end());
  } else {
    ++run_.skipped.malformed_messages;
  }
}

void RunCollector::add_image(Bytes data, const EventPlace& place) {
  const std::optional<ImageMessage> message = decode_image(data);
  if (!message) {
    ++run_.skipped.malformed_messages;
  } else if (!message->supported) {
    ++run_.skipped.unsupported_images;
  } else {
    const Bytes pixels = message->image.bytes;
    const std::uint64_t within = pixels.empty() ? 0 : static_cast<std::uint64_t>(pixels.data() - data.data());
    const fs::path relative = run_.folder.empty() ? place.file : place.file.lexically_relative(run_.folder);
    run_.frames.push_back({message->stamp, (relative.empty() ? place.file : relative).string(),
                           FramePart{place.offset + within, pixels.size(), message->image.format}});
    arrivals_.frames.push_back(arrival_);
  }
}

void RunCollector::add_mark(std::string_view text) {
  const std::optional<SegmentMark> mark = parse_segment_mark(text);
  Segments& segments = in_frames_part_ ? images_ : samples_;
  const std::uint64_t expected = segments.current ? *segments.current + 1 : 0;
  if (!mark || mark->number < expected) {
    ++run_.skipped.malformed_messages;
    return;
  }
  if (!segments.current && !in_frames_part_) run_.from_the_start = mark->number == 0;
  segments.missing += mark->number - expected;
  segments.lost_events = mark->lost_events;  // the mark counts since the session began
  segments.current = mark->number;
}

void RunCollector::add_true_map(Bytes data) {
  const std::optional<map_chunk_t> chunk = decode_map_chunk(data);
  const auto landmarks = chunk ? true_landmarks(*chunk) : std::vector<TrueLandmark>{};
  const auto has_name = [](const TrueLandmark& landmark) { return landmark.identity >= 0; };
  if (!chunk || !std::ranges::all_of(landmarks, has_name)) {
    ++run_.skipped.malformed_messages;
    return;
  }
  for (const TrueLandmark& landmark : landmarks) {
    if (true_identities_.insert(landmark.identity).second) run_.landmarks.push_back(landmark);
  }
}

/// Uses the tables among the documents: frames, and landmarks, whose table holds more data than the map. A table with
/// errors counts as a malformed message.
void RunCollector::use_tables() {
  const auto use = [this](const char* name, auto read, auto& rows) {
    const auto document = documents_.find(name);
    if (document == documents_.end()) return;
    FileErrors errors;
    auto read_rows = read(TableText{document->second, name}, errors);
    if (errors.empty()) rows = std::move(read_rows);
    if (!errors.empty()) ++run_.skipped.malformed_messages;
  };
  if (run_.frames.empty()) use(kFramesFile, read_frames_table, run_.frames);
  use(kLandmarksFile, read_landmarks_table, run_.landmarks);
}

void RunCollector::use_texts() {
  if (const auto document = documents_.find(kConfigurationDocument); document != documents_.end()) {
    run_.configuration_toml = std::move(document->second);
    run_.configuration_file = file_.string() + " (" + kConfigurationDocument + ')';
  }
  if (const auto document = documents_.find(kMapDocument); document != documents_.end())
    run_.map = std::move(document->second);
  if (const auto document = documents_.find(kOdometryDocument); document != documents_.end()) {
    if (const auto kept = decode_kept_odometry(std::as_bytes(std::span(document->second))))
      run_.since_map = kept->since;
    else
      ++run_.skipped.malformed_messages;
  }
  if (const auto document = documents_.find(kVersionDocument); document != documents_.end())
    run_.recorded_by = document->second.substr(0, document->second.find('\n'));
}

/// Repairs clock jumps. A daemon's recording is left alone, because its stamps advance evenly, and a replay must give
/// the same estimates. So are images from a separate part, because their order relative to the other samples is
/// unknown.
void RunCollector::mend_clock() {
  if (in_frames_part_ || documents_.contains(kVersionDocument)) return;
  run_.skipped.clock_jumps =
      mend_clock_jumps(arrivals_.odometry, run_.odometry, run_.skipped.odometry_not_in_order,
                       std::tie(arrivals_.bearings, run_.bearings, run_.skipped.bearings_not_in_order),
                       std::tie(arrivals_.frames, run_.frames, run_.skipped.frames_not_in_order),
                       std::tie(arrivals_.truth, run_.truth, run_.skipped.truth_not_in_order));
}

void RunCollector::put_in_order() {
  run_.skipped.odometry_not_in_order += keep_in_order(run_.odometry);
  run_.skipped.bearings_not_in_order += keep_in_order(run_.bearings);
  run_.skipped.truth_not_in_order += keep_in_order(run_.truth);
  run_.skipped.frames_not_in_order += keep_in_order(run_.frames);
  if (has_bot_poses_) number_odometry(run_.odometry);
}

void RunCollector::account() {
  run_.skipped.missing_segments = samples_.missing;
  run_.skipped.unrecorded_events = samples_.lost_events;
  run_.skipped.missing_frame_segments = images_.missing;
  run_.skipped.unrecorded_frames = images_.lost_events;
}

void RunCollector::find_rig(FileErrors& errors) {
  if (!options_.rig_file.empty()) return use_rig(options_.rig_file, errors);
  if (const auto document = documents_.find(kRigFile); document != documents_.end()) {
    run_.rig_toml = std::move(document->second);
    run_.rig_file = file_.string() + " (" + kRigFile + ')';
    return;
  }
  const fs::path beside = rig_beside(file_);
  if (FileResult<std::string> text = read_text_file(beside)) {
    run_.rig_toml = *std::move(text);
    run_.rig_file = beside.string();
  } else if (!options_.rig_may_come_later) {
    errors.push_back({file_.string(), 0,
                      "holds no rig.toml on " + options_.channel_prefix + std::string(channel::kDocument) +
                          ", and beside it " + text.error().front().text() +
                          "; give it with --rig FILE, or find one: azimuth import makes a run folder without"});
  }
}

void RunCollector::use_rig(const fs::path& file, FileErrors& errors) {
  FileResult<std::string> text = read_text_file(file);
  if (!text) {
    errors.insert(errors.end(), text.error().begin(), text.error().end());
    return;
  }
  run_.rig_toml = *std::move(text);
  run_.rig_file = file.string();
}

/// A hint at channels with suitable contents; empty: there are none.
std::string RunCollector::meant(Holds what, std::string_view option) const {
  std::string channels;
  for (const auto& [channel, holds] : foreign_)
    if (holds == what) channels += (channels.empty() ? "; perhaps " : " or ") + std::string(option) + ' ' + channel;
  return channels;
}

void RunCollector::check(FileErrors& errors) const {
  const auto require = [&](bool good, const std::string& channel, const std::string& instead) {
    if (good) return;
    const std::string skipped = run_.skipped.text();
    errors.push_back(
        {file_.string(), 0,
         "holds no usable message on " + channel + (skipped.empty() ? "" : " (skipped: " + skipped + ')') + instead});
  };
  const std::string& foreign = options_.odometry_channel;
  require(!run_.odometry.empty(), foreign.empty() ? options_.channel_prefix + std::string(channel::kOdometry) : foreign,
          meant(Holds::odometry, "--odometry-channel"));
  require(options_.odometry_alone || sees_anything(), options_.channel_prefix + std::string(channel::kBearings),
          meant(Holds::images, "--image-channel"));
}

FileResult<Run> RunCollector::finish(std::uint64_t damaged_bytes) && {
  run_.skipped.damaged_bytes = damaged_bytes;
  mend_clock();
  put_in_order();
  account();
  use_tables();
  use_texts();
  FileErrors errors;
  find_rig(errors);
  check(errors);
  if (!errors.empty()) return failure(std::move(errors));
  if (!sees_anything()) run_.perhaps = meant(Holds::images, "--image-channel");
  return std::move(run_);
}

FileResult<Run> read_run_log(const fs::path& file, const LogOptions& options) {
  RunCollector collector(file, options);
  const FileResult<EventTotals> read =
      each_event(file, [&](const LogEvent& event, const EventPlace& place) { collector.add(event, place); });
  if (!read) return failure(read.error());
  std::uint64_t damaged_bytes = read->damaged_bytes;
  const fs::path frames = file / kFramesPart;
  if (!session_segments(frames).empty()) {  // a segment without a complete event holds no images
    collector.begin_frames();
    const auto images =
        each_event(frames, [&](const LogEvent& event, const EventPlace& place) { collector.add(event, place); });
    if (images) damaged_bytes += images->damaged_bytes;
  }
  return std::move(collector).finish(damaged_bytes);
}

}  // namespace azimuth
