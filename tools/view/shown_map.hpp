#pragma once
#include <azimuth/expectations_t.hpp>
#include <azimuth/landmark_t.hpp>
#include <azimuth/map_chunk_t.hpp>
#include <azimuth/sightings_t.hpp>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <unordered_map>

#include "drivers/wire/pieces.hpp"

namespace azimuth {

/// Records when landmarks entered the map and when they were last seen. Times are seconds since the start of the shown
/// period.
///
/// Thread contract: thread-bound. Stores only the landmarks of the last map, and at most `most`.
class LandmarkHistory {
 public:
  static constexpr double kNew_s = 5.0, kUnseenDriving_s = 30.0;
  static constexpr int kDoubtedFrom = 2;  // rejected bearings; a single one may belong to another landmark

  explicit LandmarkHistory(std::size_t most) : most_(most) {}

  /// Takes a complete map. Only the first `most` landmarks are stored.
  void take_map(std::span<const landmark_t> landmarks, double t_s);
  /// A bearing of the landmark was used in an update.
  void saw(std::int64_t landmark, double t_s);
  /// The gate rejected this many successive bearings of the landmark.
  void contradicted(std::int64_t landmark, int in_a_row);
  /// Adds driving time.
  void drove(double seconds) { driving_s_ += seconds; }
  void clear() { *this = LandmarkHistory(most_); }

  /// The JSON members "landmarks": [[id, identity, x, y, xx, xy, yy, z, sigma_z, last_seen_t, state]], "more".
  nlohmann::json json(std::span<const landmark_t> landmarks) const;

 private:
  struct Known {
    double first_t_s = 0.0;
    std::optional<double> last_seen_t_s;
    double last_seen_driving_s = 0.0;
    int rejected_in_row = 0;
  };
  const char* state(const Known& known) const;

  std::size_t most_;
  double map_t_s_ = 0.0, driving_s_ = 0.0;
  bool any_map_ = false, any_sighting_ = false;
  std::unordered_map<std::int64_t, Known> known_;
};

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
