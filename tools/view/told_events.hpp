#pragma once
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "tools/view/event.hpp"
#include "tools/view/lookers.hpp"
#include "tools/view/reception.hpp"

namespace azimuth {

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
