#include "tools/view/message_parts.hpp"

#include <algorithm>

namespace azimuth {

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

}  // namespace azimuth
