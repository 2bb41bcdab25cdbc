#include "tools/view/told_events.hpp"

#include <utility>

namespace azimuth {

void ToldEvents::tell(EventKind kind, nlohmann::json data, const Reception& now) {
  data["sent_us"] = now.wall_us;
  last_ = now.at;
  ViewEvent event = made(kind, data);
  lookers_->push(event);
  if (kind == EventKind::journal) {
    journal_.push_back(std::move(event));
    if (journal_.size() > journal_lines_) journal_.pop_front();
  } else if (kind != EventKind::beat) {
    newest_.at(static_cast<std::size_t>(kind)) = std::move(event);
  }
}

void ToldEvents::beat(const Reception& now) {
  if (now.at >= next_beat()) tell(EventKind::beat, nlohmann::json::object(), now);
}

std::vector<ViewEvent> ToldEvents::newest() const {
  std::vector<ViewEvent> events(journal_.begin(), journal_.end());
  for (const std::optional<ViewEvent>& event : newest_)
    if (event) events.push_back(*event);
  return events;
}

}  // namespace azimuth
