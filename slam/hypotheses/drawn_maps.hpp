#pragma once
#include <span>
#include <vector>

#include "slam/hypotheses/believed_pose.hpp"
#include "slam/hypotheses/drawn_map.hpp"
#include "slam/hypotheses/workers.hpp"

namespace azimuth {

struct DrawnMapsSettings {
  DrawnMapSettings map;
  int populations = 16, members = 10;  ///< members: maps per population
};

/// Pose of the robot from many drawn maps (mathematics VI.31), in parallel populations. Within a population, maps that
/// predict badly are replaced by copies of maps that predict well. Populations exchange nothing, so their mean and
/// spread are those of independent answers.
///
/// Thread contract: thread-bound; work is distributed by `workers`. The same calls give the same bits, regardless of
/// the workers.
class DrawnMaps {
 public:
  explicit DrawnMaps(const DrawnMapsSettings& settings);

  /// Adds the first image, at the start of the map.
  void begin(std::span<const NamelessSighting> sightings, Workers& workers);
  /// Adds the next image, at the end of `motion` and `after_s` after the image before.
  void add_image(const Motion& motion, std::span<const NamelessSighting> sightings, Workers& workers, double after_s);

  /// Pose at the last image.
  BelievedPose pose() const { return belief_; }

 private:
  struct Population {
    Draws draws;
    std::vector<DrawnMap> maps;
    std::vector<double> log_weights;
    BelievedPose belief{};
  };
  void take(std::span<const NamelessSighting> sightings, Workers& workers, const Motion* motion);
  static void weigh(Population& population);
  static void resample(Population& population);
  void conclude();

  DrawnMapsSettings settings_;
  std::vector<Population> populations_;
  BelievedPose belief_;
  double now_s_ = 0.0;
};

}  // namespace azimuth
