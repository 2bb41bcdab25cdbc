#include "tests/daemon/recorded_messages.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "drivers/storage/event_log.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/messages.hpp"

namespace azimuth::test {
namespace {

template <class Message>
void decode_into(std::vector<Message>& messages, Bytes data, std::size_t& undecodable) {
  Message message;
  if (message.decode(data.data(), 0, static_cast<int>(data.size())) == static_cast<int>(data.size())) {
    messages.push_back(message);
  } else {
    ++undecodable;
  }
}

template <class Sample>
void keep(std::vector<Sample>& samples, std::optional<Sample> sample, std::size_t& undecodable) {
  if (sample) {
    samples.push_back(*std::move(sample));
  } else {
    ++undecodable;
  }
}

void add(RecordedMessages& all, std::string_view name, Bytes data) {
  all.largest_bytes = std::max(all.largest_bytes, data.size());
  if (name == channel::kPose) return decode_into(all.poses, data, all.undecodable);
  if (name == channel::kBotPose) return decode_into(all.bot_poses, data, all.undecodable);
  if (name == channel::kMapChunk) return decode_into(all.map_chunks, data, all.undecodable);
  if (name == channel::kPath) return decode_into(all.paths, data, all.undecodable);
  if (name == channel::kStatus) return decode_into(all.statuses, data, all.undecodable);
  if (name == channel::kSightings) return keep(all.sightings, decode_sightings(data), all.undecodable);
  if (name == channel::kExpected) return keep(all.expectations, decode_expectations(data), all.undecodable);
  if (name == channel::kKept) return keep(all.kept, decode_kept(data), all.undecodable);
  if (name == channel::kDocument) return keep(all.documents, decode_document(data), all.undecodable);
  if (name == channel::kOdometry) return keep(all.odometry, decode_odometry(data), all.undecodable);
  if (name == channel::kBearings) return keep(all.bearings, decode_bearings(data), all.undecodable);
  if (name == channel::kFeatures) return keep(all.bearings, decode_features(data), all.undecodable);
  all.foreign_channels.emplace_back(name);
}

}  // namespace

RecordedMessages read_messages(const std::filesystem::path& log, const std::string& prefix) {
  RecordedMessages all;
  FileResult<EventLogReader> reader = EventLogReader::open(log);
  if (!reader) {
    ADD_FAILURE() << text(reader.error());
    return all;
  }
  while (const auto event = reader->next()) {
    if (event->channel.starts_with(prefix)) {
      add(all, event->channel.substr(prefix.size()), event->data);
    } else {
      all.foreign_channels.emplace_back(event->channel);
    }
  }
  EXPECT_EQ(reader->damaged_bytes(), 0U);
  return all;
}

}  // namespace azimuth::test
