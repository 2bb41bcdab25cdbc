#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

#include "slam/estimator/judgement.hpp"
#include "slam/localisation/relocaliser.hpp"
#include "slam/lost/agreement_watch.hpp"

namespace azimuth {

/// A smaller map says little about being lost.
inline constexpr std::size_t kFewestEstablished = 6;
/// How far from the pose found one image may put it: little enough to be linear in.
inline constexpr double kNear_m = 0.5, kNear_rad = 0.2;
/// Of a covariance that takes the landmarks' errors as independent.
inline constexpr double kDoubtfulFactor = 4.0;

/// Independent along each axis and in heading.
Eigen::Matrix3d independent(double sigma_m, double sigma_rad);

/// Being lost and found again, for any filter with a map: notices that the robot is not where it should be, searches
/// for it while the filter leaves the map as it is, and says so of its health. What an image shows of what it should,
/// what is known and in which directions things are seen, the filter says.
///
/// Thread contract: thread-bound.
class LostRobot {
 public:
  explicit LostRobot(const RelocalisationSettings& settings) : settings_(settings), watch_(settings) {}

  /// An image. True: the robot is lost, and a search is to begin.
  bool notices(const ImageAgreement& image) {
    watch_.add(image);
    return watch_.is_lost();
  }
  /// Enough to leave the map as it is until this is settled.
  bool is_in_doubt() const { return watch_.doubts(); }
  /// Nothing speaks against the pose.
  bool is_certain() const { return watch_.is_certain() && !searching_; }
  bool is_searched_for() const { return searching_; }

  /// The robot can be anywhere in the map, facing anywhere, or only `within`.
  void begin_search(std::span<const KnownLandmark> map, const CameraView& view,
                    const std::optional<Whereabouts>& within);
  /// The covariance of a pose of which nothing is known.
  static Eigen::Matrix3d anywhere();

  /// The robot moved; nothing happens unless it is searched for.
  void predict(const Motion& motion);
  /// While it is searched for: an image's directions. The pose once there is hardly a doubt left.
  std::optional<PoseHypothesis> look(std::span<const SeenDirection> directions);
  /// Several places on the map look alike, and this one near where odometry puts the robot, which was tracked until it
  /// was lost: wheels slip more often than robots are carried to a place that looks the same.
  std::optional<PoseHypothesis> nearby(const Pose2& T_map_body) const;

  /// The search is over, or not needed.
  void was_found();

  /// What being lost, or in doubt, makes of the health; nothing: neither.
  std::optional<Judgement> judgement() const;

 private:
  RelocalisationSettings settings_;
  AgreementWatch watch_;
  std::optional<Relocaliser> relocaliser_;  ///< once it was needed
  bool searching_ = false;
};

}  // namespace azimuth
