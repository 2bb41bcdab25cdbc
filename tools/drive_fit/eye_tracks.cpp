#include "tools/drive_fit/eye_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "slam/association/descriptor_block.hpp"
#include "slam/geometry/angle.hpp"
#include "slam/geometry/index.hpp"
#include "tools/drive_fit/drive_motions.hpp"

namespace azimuth {
namespace {

// No robot on wheels with a camera turns faster, and none farther between two images that show the same.
constexpr double kMostTurn_rad_per_s = 2.5, kMostTurn_rad = 1.2;
// How far what is near moves in an image beside the turn that is common to all.
constexpr double kParallax_rad = 0.2;
// By as much as this moves what is 2.5 m away.
constexpr double kFollowed_m = 0.5;
// A bearing's share in a turn fades to none over this.
constexpr double kOfOneTurn_rad = 0.1;
// Of two matches the worse one must be so many times as bad, else neither is believed.
constexpr double kClearly = 2.0;
constexpr double kLeastApart_rad = 0.02;  // nearer together is never clear
// Squared: descriptors' distance to the nearest over that to the next one.
constexpr double kMostAlike = 0.7 * 0.7;
constexpr double kForgotten_s = 1.5;
constexpr int kMostMissed = 2;
constexpr std::size_t kLeastSightings = 3;
// Bearings of an image: as many as a graph of the whole drive is solved with in seconds.
constexpr std::size_t kEnough = 12;

struct Track {
  Identity name = 0;
  Kind kind = kAnyKind;
  Descriptor looks;
  double azimuth_rad = 0.0;     // where it would be seen now, had the robot stood
  double rate_rad_per_s = 0.0;  // beside the common turn
  double since_s = 0.0;
  int missed = 0;
};

/// What a bearing may be of, and how far off it is then.
struct Pair {
  std::size_t track = 0, bearing = 0;
  double off_rad = 0.0;
};

std::int32_t squared_distance(const Descriptor& a, const Descriptor& b) {
  return dot_product(a, a) - 2 * dot_product(a, b) + dot_product(b, b);
}

class Eye {
 public:
  /// After so much driving.
  void look(BearingSet& set, double driven_m) {
    if (driven_m > kFollowed_m) tracks_.clear();
    for (Track& track : tracks_) go_on(track, to_seconds(set.stamp - last_));
    const double after_s = std::exchange(begun_, true) ? to_seconds(set.stamp - last_) : 0.0;
    last_ = set.stamp;
    find_pairs(set);
    turn_along(std::min(kMostTurn_rad, kMostTurn_rad_per_s * after_s));
    std::vector<std::optional<std::size_t>> seen(set.bearings.size());
    for (const Pair& pair : pairs_)
      if (is_clear(pair)) seen[pair.bearing] = pair.track;
    for (Track& track : tracks_) ++track.missed;
    for (std::size_t i = 0; i < set.bearings.size(); ++i) name(set, i, seen[i]);
    std::erase_if(tracks_,
                  [](const Track& track) { return track.missed > kMostMissed || track.since_s > kForgotten_s; });
  }

 private:
  static void go_on(Track& track, double after_s) {
    track.azimuth_rad = wrap(track.azimuth_rad + track.rate_rad_per_s * after_s);
    track.since_s += after_s;
  }

  void find_pairs(const BearingSet& set) {
    pairs_.clear();
    const bool has_looks = set.descriptors.size() == set.bearings.size();
    for (std::size_t bearing = 0; bearing < set.bearings.size(); ++bearing)
      for (std::size_t track = 0; track < tracks_.size(); ++track)
        if (same_kind(tracks_[track].kind, set.bearings[bearing].kind))
          pairs_.push_back({track, bearing, wrap(set.bearings[bearing].azimuth_rad - tracks_[track].azimuth_rad)});
    if (has_looks) keep_alike(set);
  }

  /// Of each bearing the track that looks most like it, if no other one does nearly as much.
  void keep_alike(const BearingSet& set) {
    std::vector<Pair> alike;
    for (std::size_t first = 0; first < pairs_.size();) {
      const std::size_t bearing = pairs_[first].bearing;
      std::size_t best = first;
      std::int32_t least = std::numeric_limits<std::int32_t>::max(), next = least;
      for (; first < pairs_.size() && pairs_[first].bearing == bearing; ++first) {
        const std::int32_t apart = squared_distance(tracks_[pairs_[first].track].looks, set.descriptors[bearing]);
        if (apart < least) {
          next = std::exchange(least, apart);
          best = first;
        } else {
          next = std::min(next, apart);
        }
      }
      if (static_cast<double>(least) < kMostAlike * static_cast<double>(next)) alike.push_back(pairs_[best]);
    }
    pairs_ = std::move(alike);
  }

  /// By what most bearings have in common: they all turn by the same, whatever the robot is.
  void turn_along(double most_rad) {
    double turn_rad = 0.0, most = votes(0.0);
    for (const Pair& pair : pairs_) {
      if (std::abs(pair.off_rad) > most_rad) continue;
      // Of turns that explain as much the smaller one.
      if (const double told = votes(pair.off_rad) - std::abs(pair.off_rad); told > most) {
        most = told;
        turn_rad = pair.off_rad;
      }
    }
    for (Track& track : tracks_) track.azimuth_rad = wrap(track.azimuth_rad + turn_rad);
    for (Pair& pair : pairs_) pair.off_rad = wrap(pair.off_rad - turn_rad);
  }

  /// Each bearing has one.
  double votes(double turn_rad) const {
    double sum = 0.0, best = 0.0;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      best = std::max(best, 1.0 - std::abs(wrap(pairs_[i].off_rad - turn_rad)) / kOfOneTurn_rad);
      if (i + 1 < pairs_.size() && pairs_[i + 1].bearing == pairs_[i].bearing) continue;
      sum += std::exchange(best, 0.0);
    }
    return sum;
  }

  /// No other bearing may be of this track as well, and no other track be seen there.
  bool is_clear(const Pair& pair) const {
    const double off_rad = std::abs(pair.off_rad);
    if (off_rad > kParallax_rad) return false;
    return std::ranges::none_of(pairs_, [&](const Pair& other) {
      const bool is_rival = (other.track == pair.track) != (other.bearing == pair.bearing);
      return is_rival && std::abs(other.off_rad) < std::max(kLeastApart_rad, kClearly * off_rad);
    });
  }

  void name(BearingSet& set, std::size_t at, std::optional<std::size_t> seen) {
    Bearing& bearing = set.bearings[at];
    if (!seen) {
      seen = tracks_.size();
      tracks_.push_back({.name = next_++, .kind = bearing.kind, .looks = {}, .azimuth_rad = bearing.azimuth_rad});
    }
    Track& track = tracks_[*seen];
    if (track.since_s > 0.0) track.rate_rad_per_s += wrap(bearing.azimuth_rad - track.azimuth_rad) / track.since_s;
    track.azimuth_rad = bearing.azimuth_rad;
    if (at < set.descriptors.size()) track.looks = set.descriptors[at];
    track.since_s = 0.0;
    track.missed = 0;
    bearing.identity = track.name;
  }

  std::vector<Track> tracks_;
  std::vector<Pair> pairs_;  // by bearing
  Stamp last_{};
  bool begun_ = false;
  Identity next_ = 0;
};

using Sightings = std::vector<std::size_t>;  // the images that show a track

std::map<Identity, Sightings> sightings_of(const std::vector<BearingSet>& sets) {
  std::map<Identity, Sightings> tracks;
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (const Bearing& bearing : sets[i].bearings) tracks[bearing.identity].push_back(i);
  return tracks;
}

/// The longest tracks first, as long as most of their images want more.
std::set<Identity> worth_keeping(const std::vector<BearingSet>& sets) {
  const std::map<Identity, Sightings> tracks = sightings_of(sets);
  std::vector<Identity> longest;
  for (const auto& [name, images] : tracks)
    if (images.size() >= kLeastSightings) longest.push_back(name);
  std::ranges::stable_sort(longest, std::ranges::greater(), [&](Identity name) { return tracks.at(name).size(); });
  std::vector<std::size_t> kept_in(sets.size());
  std::set<Identity> kept;
  for (const Identity name : longest) {
    const Sightings& images = tracks.at(name);
    const auto wanting = std::ranges::count_if(images, [&](std::size_t image) { return kept_in[image] < kEnough; });
    if (2 * as_size(wanting) < images.size()) continue;
    kept.insert(name);
    for (const std::size_t image : images) ++kept_in[image];
  }
  return kept;
}

}  // namespace

void name_by_eye(Drive& drive, const OdometryRig& odometry) {
  std::vector<Stamp> stamps;
  for (const BearingSet& set : drive.sets) stamps.push_back(set.stamp);
  const std::vector<Pose2> poses = odometry_at(drive.odometry, odometry, stamps);
  Eye eye;
  for (std::size_t i = 0; i < drive.sets.size(); ++i)
    eye.look(drive.sets[i], i == 0 ? 0.0 : (poses[i].position() - poses[i - 1].position()).norm());
  const std::set<Identity> kept = worth_keeping(drive.sets);
  for (BearingSet& set : drive.sets)
    for (Bearing& bearing : set.bearings)
      if (!kept.contains(bearing.identity)) bearing.identity = kUnknownIdentity;
}

}  // namespace azimuth
