#include "tools/view/event.hpp"

#include <array>
#include <fmt/format.h>

namespace azimuth {

std::string_view to_string(EventKind kind) {
  constexpr std::array<std::string_view, kEventKinds> kNames{
      "hello", "trail",    "truth_trail", "journal", "missed",  "pose",      "truth", "map",
      "path",  "bearings", "status",      "picture", "silence", "restarted", "beat"};
  return kNames.at(static_cast<std::size_t>(kind));
}

ViewEvent make_event(EventKind kind, std::uint64_t id, const nlohmann::json& data) {
  return {kind, std::make_shared<const std::string>(
                    fmt::format("event: {}\nid: {}\ndata: {}\n\n", to_string(kind), id,
                                data.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)))};
}

}  // namespace azimuth
