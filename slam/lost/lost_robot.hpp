#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

#include "slam/estimator/judgement.hpp"
#include "slam/localisation/relocalisation_settings.hpp"
#include "slam/localisation/relocaliser.hpp"

namespace azimuth {

/// Distance driven within which landmarks seen before should still be seen.
inline constexpr double kMoment_m = 1.5;

/// The landmarks that an image should show, and how many of them it does show.
struct ImageAgreement {
  int expected = 0;     ///< Landmarks in view that were seen a moment ago
  int bearings = 0;     ///< Bearings in the image
  int explained = 0;    ///< Bearings that agree with some predicted landmark
  double chance = 0.0;  ///< Probability that a bearing agrees by accident
  /// Set where a better model of the image exists: ln P(image | robot elsewhere) / P(image | robot here). Of the
  /// numbers above only `expected` is used then.
  std::optional<double> log_odds = {};
};

/// Detects that a robot is not where the filter believes (carried away, or wheels spinning on the spot): images still
/// show landmarks, but not those that were there a moment ago. A sequential test: the log odds of being lost grow with
/// each landmark that is missed, shrink with each one that is found, and never fall below 0.
///
/// Thread contract: thread-bound.
class AgreementWatch {
 public:
  explicit AgreementWatch(const RelocalisationSettings& settings) : settings_(settings) {}

  void add(const ImageAgreement& image);
  /// The evidence suffices to stop changing the map until the doubt is resolved.
  bool doubts() const { return settings_.lost_log_odds > 0.0 && log_odds_ > settings_.doubt_log_odds; }
  bool is_lost() const { return settings_.lost_log_odds > 0.0 && log_odds_ > settings_.lost_log_odds; }
  /// There is no evidence for being lost.
  bool is_certain() const { return log_odds_ <= 0.0; }
  void settle() { log_odds_ = 0.0; }

 private:
  RelocalisationSettings settings_;
  double usual_share_ = 0.7;  ///< Usual share of the expected landmarks that are found
  double log_odds_ = 0.0;
};

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
