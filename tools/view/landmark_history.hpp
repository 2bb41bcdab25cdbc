#pragma once
#include <azimuth/landmark_t.hpp>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <unordered_map>

namespace azimuth {

/// Since when landmarks are in the map, and when they were last seen: what no single map says. Times are seconds since
/// the time at which what is shown begins.
///
/// Thread contract: thread-bound. Knows no more landmarks than it was last given, and no more than `most`.
class LandmarkHistory {
 public:
  static constexpr double kNew_s = 5.0, kUnseenDriving_s = 30.0;
  static constexpr int kDoubtedFrom = 2;  // refused bearings; one may be of something else

  explicit LandmarkHistory(std::size_t most) : most_(most) {}

  /// A whole map; of more than `most` landmarks the first ones.
  void take_map(std::span<const landmark_t> landmarks, double t_s);
  /// It corrected the pose.
  void saw(std::int64_t landmark, double t_s);
  /// So many bearings in a row were taken for it, and refused.
  void contradicted(std::int64_t landmark, int in_a_row);
  /// The robot drove, for so long.
  void drove(double seconds) { driving_s_ += seconds; }
  void clear() { *this = LandmarkHistory(most_); }

  /// "landmarks": [[id, identity, x, y, xx, xy, yy, z, sigma_z, last_seen_t, state]], "more".
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

}  // namespace azimuth
