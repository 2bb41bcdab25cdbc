#pragma once
#include <bit>
#include <cstdint>
#include <string_view>

#include "slam/hypotheses/beam.hpp"

namespace azimuth {

/// What speaks for and against the newest pose of a beam.
struct TrustEvidence {
  bool narrow_view = false;  ///< few landmarks are seen at once
  int images = 0;            ///< so far
  bool from_saved_map = false;
  int landmarks = 0;           ///< of the best member
  double explained = 0.0;      ///< share of the bearings seen last that are of landmarks
  double missing = 0.0;        ///< share of the landmarks that should have been seen lately and were not
  double elsewhere = 0.0;      ///< weight of the members that have the robot somewhere else than the best one has
  double spread = 1.0;         ///< standard deviation of the position by all members, over that by the best one
  double recent_chi2 = 0.0;    ///< of the last motions, against odometry, per degree of freedom
  double odometry_chi2 = 0.0;  ///< of the pose against that of odometry alone, three degrees of freedom
};
TrustEvidence trust_evidence(const Beam& beam, const Beam::PoseBelief& odometry_alone);

/// Whether a pose can be relied on as far as its covariance says.
struct Trust {
  std::string_view doubt;  ///< static text, why not; empty: it can
  bool trusted() const { return doubt.empty(); }
};
/// By this image alone.
Trust trust(const TrustEvidence& evidence);

/// Of the last images, in how many something spoke against relying on the pose. Thread contract: thread-bound.
class RecentDoubts {
 public:
  void add(const TrustEvidence& evidence);  ///< of the next image
  /// Whether so many were in doubt that the next one is too, whatever it says: not every image contradicts a map that
  /// is wrong.
  bool prevail() const { return std::popcount(doubted_) > kMostDoubted * images_; }

 private:
  static constexpr int kImages = 36;
  static constexpr double kMostDoubted = 2.0 / 3.0;

  std::uint64_t doubted_ = 0;  // a bit for each image, the last one first
  int images_ = 0;
};
Trust trust(const TrustEvidence& evidence, const RecentDoubts& recent);

/// The probability that all members are wrong, so that the robot is where odometry alone has it.
double probability_all_wrong(const TrustEvidence& evidence);
/// How far the pose goes from the members' to odometry's.
double share_of_odometry(const TrustEvidence& evidence);

}  // namespace azimuth
