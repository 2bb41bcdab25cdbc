#pragma once
#include <azimuth/expectations_t.hpp>
#include <azimuth/map_chunk_t.hpp>
#include <azimuth/sightings_t.hpp>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

#include "drivers/wire/pieces.hpp"
#include "tools/view/landmark_history.hpp"

namespace azimuth {

/// The newest map with the history of its landmarks. Times are seconds since the start of the shown period.
///
/// Thread contract: thread-bound. Its memory is bounded like that of LandmarkHistory.
class ShownMap {
 public:
  explicit ShownMap(std::size_t most) : history_(most) {}

  /// Takes a piece of a map. True if the map is now complete: utime() is then valid, and changed() should be called.
  bool take(const map_chunk_t& piece);
  std::int64_t utime() const { return pieces_.utime(); }
  /// The map as JSON without its time; nothing if it has not changed.
  std::optional<nlohmann::json> changed(double t_s);

  void take(const sightings_t& sightings, double t_s);
  void take(const expectations_t& expectations);
  void drove(double seconds) { history_.drove(seconds); }

 private:
  LandmarkHistory history_;
  MapPieces pieces_;
  std::int64_t sequence_ = 0;
  nlohmann::json told_;
};

}  // namespace azimuth
