#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "tools/view/live_view.hpp"
#include "tools/view/lookers.hpp"

namespace azimuth {

/// The event stream for one client: hello, then the trail so far in pieces as fast as the client reads, then the newest
/// event of each kind, then live events. When the content of hello changes, in particular when the daemon restarts, the
/// stream starts again.
///
/// Thread contract: thread-bound. Borrows view and lookers.
class Looker {
 public:
  Looker(LiveView& view, Lookers& lookers) : view_(view), lookers_(lookers) { lookers_.add(outbox_); }
  ~Looker() { lookers_.remove(outbox_); }
  Looker(const Looker&) = delete;
  Looker& operator=(const Looker&) = delete;

  /// Writes the next bytes and returns their number; 0 if there is nothing to send at present.
  std::size_t read(std::span<char> into);
  bool has_something() const;

  std::uint64_t missed() const { return outbox_.missed(); }

 private:
  enum class Phase : std::uint8_t { hello, trail, truth, live };
  std::optional<ViewEvent> next();
  void begin();

  LiveView& view_;
  Lookers& lookers_;
  Outbox outbox_;
  std::optional<std::uint64_t> generation_;  // nothing before the first event
  std::uint64_t restarts_ = 0;
  Phase phase_ = Phase::hello;
  double told_until_t_s_ = -std::numeric_limits<double>::infinity();
  std::shared_ptr<const std::string> text_;  // text of the event being sent
  std::size_t sent_ = 0;                     // number of bytes of text_ already sent
};

}  // namespace azimuth
