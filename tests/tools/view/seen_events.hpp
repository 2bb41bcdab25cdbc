#pragma once
// Parses server-sent events like a page.

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace azimuth::test {

struct SeenEvent {
  std::string name;
  nlohmann::json data;
};

/// Removes the complete events at the beginning of `text` and returns them. Throws on a line that is not part of an
/// event stream.
inline std::vector<SeenEvent> take_events(std::string& text) {
  std::vector<SeenEvent> events;
  for (std::size_t end = text.find("\n\n"); end != std::string::npos; end = text.find("\n\n")) {
    std::string_view rest(text.data(), end + 1);
    SeenEvent event;
    while (!rest.empty()) {
      const std::string_view line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(line.size() + 1);
      if (line.starts_with("event: "))
        event.name = line.substr(7);
      else if (line.starts_with("data: "))
        event.data = nlohmann::json::parse(line.substr(6));
      else if (!line.starts_with("id: "))
        throw std::runtime_error("no line of a stream: " + std::string(line));
    }
    events.push_back(std::move(event));
    text.erase(0, end + 2);
  }
  return events;
}

inline std::vector<std::string> names_of(const std::vector<SeenEvent>& events) {
  std::vector<std::string> names;
  for (const SeenEvent& event : events) names.push_back(event.name);
  return names;
}

}  // namespace azimuth::test
