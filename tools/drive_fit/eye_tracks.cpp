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

// Fastest turn of a wheeled robot with a camera, and largest turn between two images with common content.
constexpr double kMostTurn_rad_per_s = 2.5, kMostTurn_rad = 1.2;
// Largest azimuth change of a near landmark in addition to the common turn of all bearings.
constexpr double kParallax_rad = 0.2;
// Largest distance between two images. It shifts a landmark 2.5 m away by kParallax_rad.
constexpr double kFollowed_m = 0.5;
// A bearing's vote for a turn decreases to zero over this difference.
constexpr double kOfOneTurn_rad = 0.1;
// A rival match must be worse by this factor; otherwise neither match is accepted.
constexpr double kClearly = 2.0;
constexpr double kLeastApart_rad = 0.02;  // a rival nearer than this always makes a match ambiguous
// Ratio test: largest squared ratio of the nearest descriptor distance to the second nearest.
constexpr double kMostAlike = 0.7 * 0.7;
constexpr double kForgotten_s = 1.5;
constexpr int kMostMissed = 2;
constexpr std::size_t kLeastSightings = 3;
// Enough bearings per image: with this many, the graph of a whole drive is solved within seconds.
constexpr std::size_t kEnough = 12;

struct Track {
  Identity name = 0;
  Kind kind = kAnyKind;
  Descriptor looks;
  double azimuth_rad = 0.0;     // predicted azimuth without the robot's turn since the last image
  double rate_rad_per_s = 0.0;  // azimuth rate in addition to the common turn
  double since_s = 0.0;
  int missed = 0;
};

/// A candidate match of a bearing with a track, and its azimuth residual.
struct Pair {
  std::size_t track = 0, bearing = 0;
  double off_rad = 0.0;
};

std::int32_t squared_distance(const Descriptor& a, const Descriptor& b) {
  return dot_product(a, a) - 2 * dot_product(a, b) + dot_product(b, b);
}

class Eye {
 public:
  /// Names the bearings of the next image. `driven_m`: distance driven since the previous image.
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

  /// Keeps for each bearing only the track with the nearest descriptor, if it passes the ratio test.
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

  /// Applies the turn that most bearings agree on: a turn of the robot shifts all azimuths equally.
  void turn_along(double most_rad) {
    double turn_rad = 0.0, most = votes(0.0);
    for (const Pair& pair : pairs_) {
      if (std::abs(pair.off_rad) > most_rad) continue;
      // Among turns with equal votes the smallest one wins.
      if (const double told = votes(pair.off_rad) - std::abs(pair.off_rad); told > most) {
        most = told;
        turn_rad = pair.off_rad;
      }
    }
    for (Track& track : tracks_) track.azimuth_rad = wrap(track.azimuth_rad + turn_rad);
    for (Pair& pair : pairs_) pair.off_rad = wrap(pair.off_rad - turn_rad);
  }

  /// Sum of the votes for a turn, at most one per bearing. pairs_ is ordered by bearing.
  double votes(double turn_rad) const {
    double sum = 0.0, best = 0.0;
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      best = std::max(best, 1.0 - std::abs(wrap(pairs_[i].off_rad - turn_rad)) / kOfOneTurn_rad);
      if (i + 1 < pairs_.size() && pairs_[i + 1].bearing == pairs_[i].bearing) continue;
      sum += std::exchange(best, 0.0);
    }
    return sum;
  }

  /// True if no other bearing fits this track and no other track fits this bearing.
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
  std::vector<Pair> pairs_;  // ordered by bearing
  Stamp last_{};
  bool begun_ = false;
  Identity next_ = 0;
};

using Sightings = std::vector<std::size_t>;  // indices of the images that show a track

std::map<Identity, Sightings> sightings_of(const std::vector<BearingSet>& sets) {
  std::map<Identity, Sightings> tracks;
  for (std::size_t i = 0; i < sets.size(); ++i)
    for (const Bearing& bearing : sets[i].bearings) tracks[bearing.identity].push_back(i);
  return tracks;
}

/// Selects tracks, the longest first. A track is kept if at least half of its images have fewer than kEnough kept ones.
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
