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

/// The newest map, with what is known of its landmarks. Times are seconds since the time at which what is shown begins.
///
/// Thread contract: thread-bound. Bounded as LandmarkHistory is.
class ShownMap {
 public:
  explicit ShownMap(std::size_t most) : history_(most) {}

  /// Whether the map is whole with this piece: then its time is known, and changed() is to be asked.
  bool take(const map_chunk_t& piece);
  std::int64_t utime() const { return pieces_.utime(); }
  /// Without its time; nothing: it says nothing new.
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
