#include "tools/view/lcm_intake.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "drivers/estimates/estimate_messages.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/image_header.hpp"
#include "drivers/wire/image_message.hpp"
#include "drivers/wire/messages.hpp"
#include "drivers/wire/plausible.hpp"

namespace azimuth {
namespace {

/// Silence of a sender after which another process is accepted, for example a restarted daemon.
constexpr Duration kSenderSilence = std::chrono::milliseconds(500);
/// Silence of the sender of pictures after which another one is accepted. Pictures are rare.
constexpr Duration kPainterSilence = std::chrono::seconds(5);

constexpr std::array kShown{channel::kExpected, channel::kKept,     channel::kPose,      channel::kOdometry,
                            channel::kBearings, channel::kFeatures, channel::kSightings, channel::kMapChunk,
                            channel::kPath,     channel::kStatus,   channel::kDocument,  channel::kPicture,
                            channel::kTruth};

bool is_true(const pose_cov_t& pose) {
  return is_plausible(map_pose_of(pose)) && is_plausible(odom_pose_of(pose)) && health_of(pose.health) &&
         std::ranges::all_of(pose.covariance, [](double value) { return std::isfinite(value); });
}

/// Passes a valid message to `work` and returns whether it was valid.
template <class Message, class Work>
bool use(const std::optional<Message>& message, const Work& work) {
  if (message) work(*message);
  return message.has_value();
}

}  // namespace

std::optional<WholeMessage> MessageParts::take(const LcmPacket& packet, LcmPeer sender) {
  if (packet.parts == 1) return WholeMessage{packet.channel, packet.payload};
  if (packet.parts > kMostParts || packet.size > kMostBytes) return std::nullopt;
  const auto found = std::ranges::find_if(partials_, [&](const Partial& each) {
    return each.used && each.sender == sender && each.message == packet.sequence;
  });
  if (found != partials_.end()) return add(*found, packet);
  if (packet.part != 0) return std::nullopt;  // the first part was lost
  Partial& place = place_for(sender);
  place.used = true;
  place.sender = sender;
  place.message = packet.sequence;
  place.channel = packet.channel;
  place.there.assign(packet.parts, false);
  place.data.assign(packet.size, std::byte{0});
  place.bytes = 0;
  place.begun = ++begun_;
  return add(place, packet);
}

MessageParts::Partial& MessageParts::place_for(LcmPeer sender) {
  auto place = std::ranges::find_if(partials_, [&](const Partial& each) { return each.used && each.sender == sender; });
  if (place == partials_.end()) place = std::ranges::find(partials_, false, &Partial::used);
  if (place == partials_.end()) place = std::ranges::min_element(partials_, {}, &Partial::begun);
  return *place;
}

/// Adds a part. Duplicate parts, and parts that contradict the first one, are ignored.
std::optional<WholeMessage> MessageParts::add(Partial& partial, const LcmPacket& packet) {
  if (packet.size != partial.data.size() || packet.parts != partial.there.size() || partial.there[packet.part])
    return std::nullopt;
  partial.there[packet.part] = true;
  std::ranges::copy(packet.payload, partial.data.begin() + packet.offset);
  partial.bytes += packet.payload.size();
  if (!std::ranges::all_of(partial.there, [](bool there) { return there; })) return std::nullopt;
  partial.used = false;
  if (partial.bytes != partial.data.size()) return std::nullopt;
  return WholeMessage{partial.channel, partial.data};
}

LcmIntake::LcmIntake(LiveView& view, std::string channel_prefix)
    : view_(view),
      prefix_(std::move(channel_prefix)),
      daemon_(kSenderSilence),
      painter_(kPainterSilence),
      truth_(kSenderSilence) {}

void LcmIntake::accept(const LcmPacket& packet, LcmPeer sender, const LcmReceipt& receipt) {
  if (packet.part == 0) {
    const std::string_view channel = packet.channel;
    const bool is_shown =
        channel.starts_with(prefix_) && std::ranges::count(kShown, channel.substr(prefix_.size())) > 0;
    if (!is_shown) return;
  }
  const std::optional<WholeMessage> message = parts_.take(packet, sender);
  if (!message) return;
  const std::string_view channel = message->channel.substr(prefix_.size());
  const Reception heard{LiveView::Clock::time_point(receipt.stamp.time_since_epoch()),
                        to_us(receipt.stamp + receipt.wall_lead)};
  if (!is_of_the_daemon(channel, sender, receipt, heard)) return void(++counts_.other_senders);
  if (take(channel, message->data, heard))
    ++counts_.messages;
  else
    ++counts_.malformed[std::string(channel)];
}

/// The daemon sends pictures from a separate socket, and truth comes from another program, so that each has its own
/// sender choice.
bool LcmIntake::is_of_the_daemon(std::string_view channel, LcmPeer sender, const LcmReceipt& receipt,
                                 const Reception& heard) {
  LcmSenderChoice& choice = channel == channel::kPicture ? painter_ : channel == channel::kTruth ? truth_ : daemon_;
  if (!choice.would_accept(sender, receipt.stamp)) return false;
  const bool any_before = choice.changes() > 0;
  if (choice.heard(sender, receipt.stamp) && any_before && &choice == &daemon_) view_.restart(heard);
  return true;
}

bool LcmIntake::take(std::string_view channel, Bytes data, const Reception& heard) {
  if (channel == channel::kPose) {
    const std::optional<pose_cov_t> pose = decode_pose(data);
    return pose && is_true(*pose) && use(pose, [&](const pose_cov_t& each) { view_.take_pose(each, heard); });
  }
  if (channel == channel::kOdometry)
    return use(decode_odometry(data), [&](const OdometryReading&) { view_.take_odometry(); });
  if (channel == channel::kBearings)
    return use(decode_bearings(data), [&](const BearingSet& set) { view_.take_bearings(set, heard); });
  if (channel == channel::kFeatures)
    return use(decode_features(data), [&](const BearingSet& set) { view_.take_bearings(set, heard); });
  if (channel == channel::kSightings)
    return use(decode_sightings(data), [&](const sightings_t& each) { view_.take_sightings(each, heard); });
  if (channel == channel::kExpected)
    return use(decode_expectations(data), [&](const expectations_t& each) { view_.take_expectations(each, heard); });
  if (channel == channel::kKept)
    return use(decode_kept(data), [&](const kept_t& kept) { view_.take_kept(kept, heard); });
  if (channel == channel::kMapChunk)
    return use(decode_map_chunk(data), [&](const map_chunk_t& piece) { view_.take_map(piece, heard); });
  if (channel == channel::kPath)
    return use(decode_path(data), [&](const path_t& piece) { view_.take_path(piece, heard); });
  if (channel == channel::kStatus)
    return use(decode_status(data), [&](const status_t& status) { view_.take_status(status, heard); });
  if (channel == channel::kTruth)
    return use(decode_truth(data), [&](const TruthPose& truth) { view_.take_truth(truth, heard); });
  return channel == channel::kPicture ? take_picture(data, heard) : take_document(data, heard);
}

/// Accepts only a JPEG image with a stated size. The browser decodes the content.
bool LcmIntake::take_picture(Bytes data, const Reception& heard) {
  const std::optional<ImageMessage> message = decode_image(data);
  if (!message || !message->supported || message->image.format.pixels != PixelFormat::mjpeg) return false;
  const auto size_px = jpeg_size(message->image.bytes);
  if (!size_px) return false;
  view_.take_picture(message->stamp, message->image.bytes, size_px->first, size_px->second, heard);
  return true;
}

bool LcmIntake::take_document(Bytes data, const Reception& heard) {
  const std::optional<document_t> document = decode_document(data);
  if (!document) return false;
  if (document->name == "rig.toml") view_.take_rig(as_text(std::as_bytes(std::span(document->data))), heard);
  return true;
}

}  // namespace azimuth
