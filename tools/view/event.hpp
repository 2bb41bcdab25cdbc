#pragma once
// What passes from the server to a page: server-sent events (docs/view.md).

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace azimuth {

enum class EventKind : std::uint8_t {
  hello,
  trail,
  truth_trail,
  journal,
  missed,
  // Of these the newest alone matters.
  pose,
  truth,
  map,
  path,
  bearings,
  status,
  picture,
  silence,
  restarted,
  beat,
};

inline constexpr std::size_t kEventKinds = static_cast<std::size_t>(EventKind::beat) + 1;

/// As the page knows it.
std::string_view to_string(EventKind kind);

/// Whether a newer one takes the place of one that was not sent yet.
constexpr bool newest_wins(EventKind kind) { return kind >= EventKind::pose; }

/// Ready to be sent; shared by all who look.
struct ViewEvent {
  EventKind kind{};
  std::shared_ptr<const std::string> text;  ///< "event: pose\nid: 7\ndata: {...}\n\n"
};

/// `data` in ASCII on one line: no text that was sent can break the stream. Reentrant.
ViewEvent make_event(EventKind kind, std::uint64_t id, const nlohmann::json& data);

}  // namespace azimuth
