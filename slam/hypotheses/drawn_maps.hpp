#pragma once
#include <span>
#include <vector>

#include "slam/hypotheses/believed_pose.hpp"
#include "slam/hypotheses/drawn_map.hpp"
#include "slam/hypotheses/workers.hpp"

namespace azimuth {

struct DrawnMapsSettings {
  DrawnMapSettings map;
  int populations = 16, members = 10;  ///< of each population
};

/// Where the robot is, by many drawn maps (SPEC VI.31): populations side by side. Within one, maps that predict badly
/// give way to copies of those that predict well; between them nothing is exchanged, so that their mean and spread
/// stay those of independent answers.
///
/// Thread contract: thread-bound; work is spread as `workers` do. Same calls, same bits, whatever the workers.
class DrawnMaps {
 public:
  explicit DrawnMaps(const DrawnMapsSettings& settings);

  /// The first image, from where the map begins.
  void begin(std::span<const NamelessSighting> sightings, Workers& workers);
  /// The next one, at the end of `motion`, so long after the last one.
  void add_image(const Motion& motion, std::span<const NamelessSighting> sightings, Workers& workers, double after_s);

  /// At the last image.
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
