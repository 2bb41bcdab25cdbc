#include "drivers/lcm/lcm_frames.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

#include "drivers/wire/image_message.hpp"

namespace azimuth {

/// The memory of the slots. Untouched pages cost nothing, unless the process is locked in memory.
struct LcmFrames::Pool : FramePool {
  explicit Pool(std::size_t bytes)
      : FramePool(UniqueFd{}), slot_bytes(bytes), memory(std::make_unique_for_overwrite<std::byte[]>(bytes * kSlots)) {}
  std::span<std::byte> slot(unsigned index) const { return {memory.get() + index * slot_bytes, slot_bytes}; }

  std::size_t slot_bytes;
  std::unique_ptr<std::byte[]> memory;
};

LcmFrames::LcmFrames(const LcmSourceSettings& settings)
    : channel_(settings.frames_channel),
      slot_bytes_(static_cast<std::size_t>(settings.max_frame_mb * 1e6)),
      pool_(std::make_shared<Pool>(slot_bytes_)),
      free_((1U << kSlots) - 1),
      senders_(duration_from_seconds(settings.silent_s)),
      stamps_(settings.stamps, duration_from_seconds(settings.max_age_s)) {}

void LcmFrames::accept(const LcmPacket& packet, LcmPeer sender, const LcmReceipt& receipt) {
  if (packet.part == 0) {
    if (packet.channel == channel_) begin(packet, sender, receipt);
  } else if (Partial* partial = find(packet, sender)) {
    add(packet, *partial);
  }
}

LcmFrames::Partial* LcmFrames::find(const LcmPacket& packet, LcmPeer sender) {
  const auto partial = std::ranges::find_if(partials_, [&](const Partial& each) {
    return each.used && each.sender == sender && each.message == packet.sequence;
  });
  return partial == partials_.end() ? nullptr : &*partial;
}

void LcmFrames::begin(const LcmPacket& packet, LcmPeer sender, const LcmReceipt& receipt) {
  if (!senders_.would_accept(sender, receipt.stamp)) {
    ++counts_.other_senders;
    return;
  }
  if (packet.parts > 1 && find(packet, sender)) return;  // a repeated first part
  ++begun_;
  if (packet.size > slot_bytes_ || packet.parts > kMaxParts) {
    ++counts_.too_large;
    return;
  }
  Partial& partial = place_for(sender);
  unsigned slot = 0;
  if (!claim_slot(slot)) {
    ++counts_.no_room;
    return;
  }
  partial = {.used = true,
             .sender = sender,
             .message = packet.sequence,
             .size = packet.size,
             .bytes = 0,
             .parts = packet.parts,
             .there = {},
             .slot = slot,
             .sequence = begun_,
             .receipt = receipt};
  add(packet, partial);
}

/// Returns the place of the sender's message, or else a free place, or else the place of the oldest message. A sender's
/// messages come one after another, so an unfinished one stays incomplete.
LcmFrames::Partial& LcmFrames::place_for(LcmPeer sender) {
  auto place = std::ranges::find_if(partials_, [&](const Partial& each) { return each.used && each.sender == sender; });
  if (place == partials_.end()) place = std::ranges::find(partials_, false, &Partial::used);
  if (place == partials_.end()) place = std::ranges::min_element(partials_, {}, &Partial::sequence);
  if (place->used) {
    ++counts_.incomplete;
    give_up(*place);
  }
  return *place;
}

bool LcmFrames::claim_slot(unsigned& slot) {
  free_ |= pool_->take_returned();
  if (free_ == 0) return false;
  slot = static_cast<unsigned>(std::countr_zero(free_));
  free_ &= ~(1U << slot);
  return true;
}

void LcmFrames::give_up(Partial& partial) {
  free_ |= 1U << partial.slot;
  partial.used = false;
}

/// Parts that are inconsistent with the first one, or arrive twice, are ignored.
void LcmFrames::add(const LcmPacket& packet, Partial& partial) {
  if (packet.size != partial.size || packet.parts != partial.parts || partial.there.test(packet.part)) return;
  partial.there.set(packet.part);
  std::ranges::copy(packet.payload, pool_->slot(partial.slot).begin() + packet.offset);
  partial.bytes += static_cast<std::uint32_t>(packet.payload.size());
  if (partial.there.count() == partial.parts) finish(partial);
}

void LcmFrames::finish(Partial& partial) {
  if (hand_on(partial)) {
    partial.used = false;  // the slot is leased now
  } else {
    give_up(partial);
  }
}

/// False: the message is dropped, and its slot is free again.
bool LcmFrames::hand_on(const Partial& partial) {
  const Bytes bytes = pool_->slot(partial.slot).first(partial.size);
  const std::optional<ImageMessage> message = partial.bytes == partial.size ? decode_image(bytes) : std::nullopt;
  if (!message || (message->supported && message->image.bytes.empty())) {
    ++counts_.malformed;
    return false;
  }
  if (!message->supported) {
    ++counts_.unsupported;
    return false;
  }
  if (!senders_.would_accept(partial.sender, partial.receipt.stamp)) {  // another sender has taken over meanwhile
    ++counts_.other_senders;
    return false;
  }
  const std::optional<Stamp> stamp = stamps_.judge(message->stamp, partial.receipt);
  if (!stamp) return false;
  senders_.heard(partial.sender, partial.receipt.stamp);
  if (unread_) ++counts_.replaced;
  unread_ = Frame(pool_, partial.slot, message->image.format, message->image.bytes);
  unread_.stamp = *stamp;
  unread_.sequence = partial.sequence;
  ++counts_.frames;
  return true;
}

bool LcmFrames::take(Frame& into) {
  if (!unread_) return false;
  into = std::move(unread_);
  unread_ = Frame{};
  return true;
}

}  // namespace azimuth
