#pragma once
// Server-sent events from the server to its pages (docs/view.md), and the pages that wait for them.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/view/times.hpp"

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

/// Events that wait to be sent to one client. The outbox holds at most one event of each kind with newest_wins(), and
/// kMostLines of the other kinds together. Replaced and dropped events are counted.
///
/// Thread contract: thread-bound.
class Outbox {
 public:
  static constexpr std::size_t kMostLines = 64;

  void push(const ViewEvent& event);
  /// The oldest event. If events were dropped since the last call, a `missed` event comes first.
  std::optional<ViewEvent> pop();

  bool empty() const { return waiting_.empty(); }
  std::size_t size() const { return waiting_.size(); }
  /// Removes all waiting events and resets missed().
  void clear();
  std::uint64_t missed() const { return missed_; }  ///< not yet reported to the client

 private:
  void drop(const std::deque<ViewEvent>::const_iterator& which);

  std::deque<ViewEvent> waiting_;
  std::uint64_t missed_ = 0, missed_ever_ = 0;
};

/// The outboxes of all clients.
///
/// Thread contract: thread-bound. Borrows the outboxes.
class Lookers {
 public:
  void add(Outbox& outbox) { outboxes_.push_back(&outbox); }
  void remove(Outbox& outbox) { std::erase(outboxes_, &outbox); }
  std::size_t size() const { return outboxes_.size(); }

  void push(const ViewEvent& event) {
    for (Outbox* const outbox : outboxes_) outbox->push(event);
  }

 private:
  std::vector<Outbox*> outboxes_;
};

/// Sends events to all clients and stores those that later clients need: the journal, and the newest event of each
/// other kind.
///
/// Thread contract: thread-bound. Borrows the lookers.
class ToldEvents {
 public:
  using Clock = std::chrono::steady_clock;
  /// Interval of beats. A client that receives nothing for much longer knows that the connection is dead.
  static constexpr std::chrono::milliseconds kBeatEvery{500};

  ToldEvents(Lookers& lookers, std::size_t journal_lines) : lookers_(&lookers), journal_lines_(journal_lines) {}

  void tell(EventKind kind, nlohmann::json data, const Reception& now);
  /// Sends a beat if no other event has been sent for a while.
  void beat(const Reception& now);
  Clock::time_point next_beat() const { return last_ + kBeatEvery; }

  /// Makes an event without sending it.
  ViewEvent made(EventKind kind, const nlohmann::json& data) { return make_event(kind, ++count_, data); }
  /// Removes the stored event of a kind that is no longer valid.
  void forget(EventKind kind) { newest_.at(static_cast<std::size_t>(kind)).reset(); }
  /// Removes all stored events except the journal, after a restart of the daemon.
  void begin_anew() { newest_ = {}; }

  /// The stored events in the order of sending.
  std::vector<ViewEvent> newest() const;
  Lookers& lookers() const { return *lookers_; }

 private:
  Lookers* lookers_;
  std::size_t journal_lines_;
  std::uint64_t count_ = 0;
  Clock::time_point last_{};
  std::array<std::optional<ViewEvent>, kEventKinds> newest_;
  std::deque<ViewEvent> journal_;
};

}  // namespace azimuth
