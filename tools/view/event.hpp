#pragma once
// Server-sent events from the server to a page (docs/view.md).

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
  // For the following kinds, only the newest event matters.
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

/// The name of the event kind for the page.
std::string_view to_string(EventKind kind);

/// True if a newer event replaces an unsent one of the same kind.
constexpr bool newest_wins(EventKind kind) { return kind >= EventKind::pose; }

/// An event ready to be sent, shared by all clients.
struct ViewEvent {
  EventKind kind{};
  std::shared_ptr<const std::string> text;  ///< "event: pose\nid: 7\ndata: {...}\n\n"
};

/// Makes an event with `data` in ASCII on one line, so that no text can break the stream. Reentrant.
ViewEvent make_event(EventKind kind, std::uint64_t id, const nlohmann::json& data);

}  // namespace azimuth
