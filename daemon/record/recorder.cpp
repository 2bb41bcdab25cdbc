#include "daemon/record/recorder.hpp"

#include <utility>

#include "drivers/storage/session.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/messages.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kTypicalMessage = 64 * 1024;

/// When the disk is full, images are deleted before samples.
LogSpace space_of_events(const RecordSettings& settings) {
  return {.folder = settings.folder,
          .yields_first = kFramesPart,
          .max_file_mb = settings.max_file_mb,
          .max_file_age_s = settings.max_file_age_s,
          .quota_mb = settings.quota_mb,
          .min_free_mb = settings.min_free_mb,
          .flush_interval_s = settings.flush_interval_s};
}

}  // namespace

Recorder::Recorder(const RecordSettings& settings, std::vector<Document> documents, EventTimes times)
    : on_(!settings.folder.empty()),
      prefix_(settings.channel_prefix),
      odometry_channel_(prefix_ + std::string(channel::kOdometry)),
      bearings_channel_(prefix_ + std::string(channel::kBearings)),
      features_channel_(prefix_ + std::string(channel::kFeatures)),
      times_(times),
      log_(space_of_events(settings), std::move(documents), settings.channel_prefix) {
  off_.reason = "no folder is configured";
  if (!on_) return;
  bearings_message_.bearings.reserve(kTypicalBearings);
  data_.reserve(kTypicalMessage);
  log_.begin({}, times_.now());
}

void Recorder::odometry(const OdometryReading& reading) {
  if (!on_) return;
  encode(to_message(reading), data_);
  log_.write(odometry_channel_, data_, times_.of_sample(reading.stamp));
}

void Recorder::bearings(const BearingSet& set) {
  if (!on_) return;
  const bool plain = is_plain(set);
  if (plain) {
    fill_message(set, bearings_message_);
    encode(bearings_message_, data_);
  } else {
    fill_message(set, features_message_);
    encode(features_message_, data_);
  }
  log_.write(plain ? bearings_channel_ : features_channel_, data_, times_.of_sample(set.stamp));
}

/// Samples reach the recorder through odometry() and bearings(). Their echoes on the published channels are skipped.
void Recorder::message(std::string_view channel, Bytes data) {
  const bool is_echo = channel == channel::kOdometry || channel == channel::kBearings || channel == channel::kFeatures;
  if (!on_ || is_echo) return;
  message_channel_.assign(prefix_).append(channel);
  log_.write(message_channel_, data, times_.now());
}

void Recorder::turn(Clock::time_point now) {
  if (on_) log_.turn(now);
}

}  // namespace azimuth
