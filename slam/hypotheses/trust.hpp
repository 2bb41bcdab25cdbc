#pragma once
#include <bit>
#include <cstdint>
#include <string_view>

#include "slam/hypotheses/beam.hpp"

namespace azimuth {

/// Evidence for and against the newest pose of a beam.
struct TrustEvidence {
  bool narrow_view = false;  ///< field of view too narrow to see many landmarks at once
  int images = 0;            ///< number of images so far
  bool from_saved_map = false;
  int landmarks = 0;           ///< number of landmarks of the best member
  double explained = 0.0;      ///< share of the recent bearings that are associated with landmarks
  double missing = 0.0;        ///< share of missed detections among those expected recently
  double elsewhere = 0.0;      ///< total weight of the members with the robot at a clearly different pose
  double spread = 1.0;         ///< standard deviation of the position by all members, over that by the best member
  double recent_chi2 = 0.0;    ///< chi-square of the recent motions against odometry, per degree of freedom
  double odometry_chi2 = 0.0;  ///< chi-square of the pose against odometry alone, three degrees of freedom
};
TrustEvidence trust_evidence(const Beam& beam, const Beam::PoseBelief& odometry_alone);

/// Whether a pose can be relied on within its covariance.
struct Trust {
  std::string_view doubt;  ///< reason not to rely on the pose, a static text; empty: reliable
  bool trusted() const { return doubt.empty(); }
};
/// The trust in the pose by the evidence of the newest image alone.
Trust trust(const TrustEvidence& evidence);

/// Counts in how many of the last images the pose was not to be trusted. Thread contract: thread-bound.
class RecentDoubts {
 public:
  void add(const TrustEvidence& evidence);  ///< evidence of the next image
  /// Whether so many images were in doubt that the next one is not to be trusted either. Not every image contradicts a
  /// wrong map.
  bool prevail() const { return std::popcount(doubted_) > kMostDoubted * images_; }

 private:
  static constexpr int kImages = 36;
  static constexpr double kMostDoubted = 2.0 / 3.0;

  std::uint64_t doubted_ = 0;  // one bit per image, lowest bit: last image
  int images_ = 0;
};
Trust trust(const TrustEvidence& evidence, const RecentDoubts& recent);

/// Probability that all members are wrong, so that the robot is where odometry alone says.
double probability_all_wrong(const TrustEvidence& evidence);
/// Share by which the estimated pose moves from the members' pose towards the pose by odometry.
double share_of_odometry(const TrustEvidence& evidence);

}  // namespace azimuth
