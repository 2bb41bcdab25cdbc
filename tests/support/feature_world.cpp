#include "tests/support/feature_world.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/world/scenario.hpp"
#include "slam/geometry/angle.hpp"
#include "tests/association/random_descriptors.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

constexpr double kSigmaBearing_rad = 0.0087;  // mathematics I.3, set 2
constexpr double kLookAlikeSigma = 12.0;      // descriptor noise between two features that look alike

Scenario room_full_of_features(std::uint64_t seed, const FeatureWorldSettings& settings) {
  Scenario scenario = lab(seed, 2);
  Random random(seed + 1000, RandomPurpose::scene);
  scenario.landmarks = line_walls({{0.0, 0.0}, {14.0, 10.0}}, 0.3, 0.2, random);
  for (const WorldLandmark& inner : line_walls({{4.5, 3.5}, {9.5, 6.5}}, 0.4, 0.2, random))
    scenario.landmarks.push_back(inner);
  for (std::size_t i = 0; i < scenario.landmarks.size(); ++i) scenario.landmarks[i].identity = static_cast<Identity>(i);
  scenario.odometer.lambda_drift_rad2_per_m = settings.heading_drift_rad2_per_m;
  scenario.sensor.sigma_bearing_rad = kSigmaBearing_rad;
  scenario.sensor.max_range_m = 5.0;
  scenario.sensor.detection_probability = settings.repeatability;
  scenario.sensor.identities = true;
  scenario.sampling.bearing_period_s = 0.6;
  return scenario;
}

class Dresser {
 public:
  Dresser(std::size_t features, std::uint64_t seed, const FeatureWorldSettings& settings)
      : settings_(settings), draws_(static_cast<unsigned>(seed) + 7000U) {
    for (std::size_t i = 0; i < features; ++i) {
      const bool alike = i > 0 && draws_.chance(settings.look_alikes);
      looks_.push_back(alike ? seen_again(looks_[static_cast<std::size_t>(draws_.integer(0, static_cast<int>(i) - 1))],
                                          kLookAlikeSigma, draws_)
                             : random_descriptor(draws_));
    }
  }

  /// Replaces the names by descriptors, adds clutter, and returns the names by azimuth.
  std::unordered_map<double, Identity> dress(BearingSet& set) {
    std::unordered_map<double, Identity> names;
    for (Bearing& bearing : set.bearings) {
      names[bearing.azimuth_rad] = bearing.identity;
      const Descriptor& looks = looks_[static_cast<std::size_t>(bearing.identity)];
      set.descriptors.push_back(seen_again(looks, settings_.looks_sigma, draws_));
      bearing.identity = kUnknownIdentity;
      bearing.sigma_rad = kSigmaBearing_rad;
    }
    for (int left = static_cast<int>(settings_.clutter_per_image); left > 0; --left) {
      Bearing& bearing = set.bearings.emplace_back();
      bearing.azimuth_rad = draws_.uniform(-kPi, kPi);
      set.descriptors.push_back(random_descriptor(draws_));
    }
    for (std::size_t at = 0; at < set.bearings.size(); ++at) set.neighbours.push_back(neighbours_of(set, at));
    return names;
  }

 private:
  static Neighbours neighbours_of(const BearingSet& set, std::size_t at) {
    std::multimap<double, std::uint16_t> by_distance;
    for (std::size_t other = 0; other < set.bearings.size(); ++other)
      if (other != at)
        by_distance.emplace(std::abs(wrap(set.bearings[other].azimuth_rad - set.bearings[at].azimuth_rad)),
                            static_cast<std::uint16_t>(other));
    Neighbours neighbours;
    std::size_t count = 0;
    for (const auto& [distance_rad, other] : by_distance)
      if (count < Neighbours::kMost) neighbours.index[count++] = other;
    return neighbours;
  }

  FeatureWorldSettings settings_;
  RandomDraws draws_;
  std::vector<Descriptor> looks_;
};

}  // namespace

FeatureWorld feature_world(std::uint64_t seed, const FeatureWorldSettings& settings) {
  const Scenario scenario = room_full_of_features(seed, settings);
  FeatureWorld world;
  world.run = simulated_run(scenario);
  Dresser dresser(scenario.landmarks.size(), seed, settings);
  for (BearingSet& set : world.run.bearings) world.truth[to_us(set.stamp)] = dresser.dress(set);
  return world;
}

std::size_t FeatureWorld::wrong(const std::vector<SightingRecord>& sightings) const {
  std::map<std::int64_t, std::map<Identity, std::size_t>> by_landmark;
  for (const SightingRecord& sighting : sightings) {
    const auto& names = truth.at(to_us(sighting.stamp));
    const auto name = names.find(sighting.azimuth_rad);
    ++by_landmark[sighting.landmark_id][name == names.end() ? kUnknownIdentity : name->second];
  }
  std::size_t wrong = 0;
  for (const auto& [landmark, votes] : by_landmark) {
    std::size_t all = 0, most = 0;
    for (const auto& [identity, count] : votes) {
      all += count;
      most = std::max(most, count);
    }
    wrong += all - most;
  }
  return wrong;
}

}  // namespace azimuth
