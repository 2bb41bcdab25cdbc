#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

#include "slam/estimator/judgement.hpp"
#include "slam/localisation/relocaliser.hpp"
#include "slam/lost/agreement_watch.hpp"

namespace azimuth {

/// Smallest number of established landmarks for which being lost can be detected.
inline constexpr std::size_t kFewestEstablished = 6;
/// Greatest distance of a pose computed from one image from the pose found: small enough for linearisation.
inline constexpr double kNear_m = 0.5, kNear_rad = 0.2;
/// Inflation of a covariance that treats the landmarks' errors as independent.
inline constexpr double kDoubtfulFactor = 4.0;

/// A pose covariance that is independent along each axis and in heading.
Eigen::Matrix3d independent(double sigma_m, double sigma_rad);

/// Detection that the robot is lost, and relocalisation, for any filter with a map. While the search runs the filter
/// does not change the map, and health is `lost`. The filter provides how well images agree with its map, the known
/// landmarks, and the measured directions.
///
/// Thread contract: thread-bound.
class LostRobot {
 public:
  explicit LostRobot(const RelocalisationSettings& settings) : settings_(settings), watch_(settings) {}

  /// Adds an image. Returns true if the robot is lost and a search must start.
  bool notices(const ImageAgreement& image) {
    watch_.add(image);
    return watch_.is_lost();
  }
  /// The evidence suffices to stop changing the map until the doubt is resolved.
  bool is_in_doubt() const { return watch_.doubts(); }
  /// Nothing contradicts the pose.
  bool is_certain() const { return watch_.is_certain() && !searching_; }
  bool is_searched_for() const { return searching_; }

  /// Starts a search with the robot anywhere in the map, with any heading, or only `within`.
  void begin_search(std::span<const KnownLandmark> map, const CameraView& view,
                    const std::optional<PositionPrior>& within);
  /// The covariance of an unknown pose.
  static Eigen::Matrix3d anywhere();

  /// The robot moved; has no effect unless a search runs.
  void predict(const Motion& motion);
  /// During a search: adds an image's directions. Returns the pose once hardly any doubt is left.
  std::optional<PoseHypothesis> look(std::span<const SeenDirection> directions);
  /// A tracked place near the odometry pose `T_map_body`, for the case that several places on the map look alike.
  /// Wheels slip more often than robots are carried to a place that looks the same.
  std::optional<PoseHypothesis> nearby(const Pose2& T_map_body) const;

  /// Ends the search, or resolves the doubt.
  void was_found();

  /// The health that follows from being lost or in doubt. Nothing if the robot is neither.
  std::optional<Judgement> judgement() const;

 private:
  RelocalisationSettings settings_;
  AgreementWatch watch_;
  std::optional<Relocaliser> relocaliser_;  ///< Created when first needed
  bool searching_ = false;
};

}  // namespace azimuth
