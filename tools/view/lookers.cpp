#include "tools/view/lookers.hpp"

#include <algorithm>
#include <utility>

namespace azimuth {

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

}  // namespace azimuth
