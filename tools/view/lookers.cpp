#include "tools/view/lookers.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

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

void Outbox::push(const ViewEvent& event) {
  const auto gives_way = [&event](const ViewEvent& other) {
    return newest_wins(event.kind) ? other.kind == event.kind : !newest_wins(other.kind);
  };
  const auto most = newest_wins(event.kind) ? std::size_t{1} : kMostLines;
  if (static_cast<std::size_t>(std::ranges::count_if(waiting_, gives_way)) >= most)
    drop(std::ranges::find_if(waiting_, gives_way));
  waiting_.push_back(event);
}

void Outbox::drop(const std::deque<ViewEvent>::const_iterator& which) {
  waiting_.erase(which);
  ++missed_;
}

std::optional<ViewEvent> Outbox::pop() {
  if (waiting_.empty()) return std::nullopt;
  if (missed_ > 0) {
    missed_ever_ += missed_;
    return make_event(EventKind::missed, missed_ever_, {{"n", std::exchange(missed_, 0)}, {"all", missed_ever_}});
  }
  ViewEvent oldest = std::move(waiting_.front());
  waiting_.pop_front();
  return oldest;
}

void Outbox::clear() {
  waiting_.clear();
  missed_ = 0;
}

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
