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
#include "tools/view/heard.hpp"
#include "tools/view/lookers.hpp"

namespace azimuth {

/// Tells those who look, and keeps what one who comes later is to be told: the journal, and of all else the newest.
///
/// Thread contract: thread-bound. Borrows the lookers.
class ToldEvents {
 public:
  using Clock = std::chrono::steady_clock;
  /// Whoever hears nothing for much longer knows that nobody is there.
  static constexpr std::chrono::milliseconds kBeatEvery{500};

  ToldEvents(Lookers& lookers, std::size_t journal_lines) : lookers_(&lookers), journal_lines_(journal_lines) {}

  void tell(EventKind kind, nlohmann::json data, const Heard& now);
  /// A beat, when nothing else has been told for a while.
  void beat(const Heard& now);
  Clock::time_point next_beat() const { return last_ + kBeatEvery; }

  /// One that is for nobody yet.
  ViewEvent made(EventKind kind, const nlohmann::json& data) { return make_event(kind, ++count_, data); }
  /// It holds no longer.
  void forget(EventKind kind) { newest_.at(static_cast<std::size_t>(kind)).reset(); }
  /// Of another daemon: only the journal goes on.
  void begin_anew() { newest_ = {}; }

  /// In the order in which to tell them.
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
