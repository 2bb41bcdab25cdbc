#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/association/joint_compatibility.hpp"
#include "slam/planar/ekf_settings.hpp"
#include "slam/planar/planar_landmark.hpp"
#include "slam/planar/planar_view.hpp"

namespace azimuth {

/// The association of an image's bearings with landmarks.
struct PlanarMatches {
  /// A bearing paired with a mapped landmark.
  struct Pair {
    std::size_t landmark;
    MappedSighting sighting;
    ObservationRow row;
    double variance_rad2;  ///< Innovation variance S = H P H^T + R
    bool accepted = true;  ///< Passed its individual gate and the joint one
  };
  std::vector<Pair> pairs;
  std::vector<Bearing> unmapped;  ///< Bearings of landmarks that are not in the map
  std::uint64_t repeated = 0;     ///< Bearings with the name of an earlier bearing in the image; not used
  std::uint64_t ambiguous = 0;    ///< Bearings not used because a rival hypothesis explains them differently
  std::uint64_t thinned = 0;      ///< Bearings not used because the last one of the same landmark was too recent

  std::size_t rejected() const;
  void clear() {
    pairs.clear();
    unmapped.clear();
    repeated = ambiguous = thinned = 0;
  }
};

/// Bearings of mapped points from which the robot's pose can be computed.
struct PlacedSightings {
  std::vector<MappedSighting> sightings;
  std::vector<std::size_t> landmarks;  ///< The landmark of each bearing

  void clear() {
    sightings.clear();
    landmarks.clear();
  }
  void add(std::size_t landmark, const MappedSighting& sighting) {
    sightings.push_back(sighting);
    landmarks.push_back(landmark);
  }
};

/// Data association of bearings with mapped landmarks, and gating of the pairs.
///
/// Returned references are valid until the next call. Thread contract: thread-bound; does not allocate once its
/// workspace has grown to the largest image.
class PlanarMatcher {
 public:
  using Landmarks = std::span<const PlanarLandmark>;

  PlanarMatcher(const EkfSettings& settings, double new_density_per_rad);

  /// Association by name; bearings without a name are not used.
  const PlanarMatches& match_names(const BearingSet& image, Landmarks landmarks, const PlanarView& view);
  /// Association by position. A bearing gets the landmark that the most likely joint hypothesis assigns, or counts as
  /// unmapped if that hypothesis says so. It is not used when a rival hypothesis disagrees.
  const PlanarMatches& match_places(const BearingSet& image, Landmarks landmarks, const PlanarView& view);

  /// The joint hypotheses that match_places() would choose from, without those far less likely than the best. The
  /// search uses less effort, since many filters run it at once.
  const JointCompatibility& weigh(const BearingSet& image, Landmarks landmarks, const PlanarView& view,
                                  double keep_log_ratio);
  /// The matches by one of these hypotheses, for the same image, landmarks and view.
  const PlanarMatches& match_weighed(const BearingSet& image, Landmarks landmarks, const PlanarView& view,
                                     std::size_t hypothesis);

  /// The named bearings of mapped points, without gating.
  const PlacedSightings& named_points(const BearingSet& image, Landmarks landmarks, const PlanarView& view);
  /// Bearings that match exactly one point, by predicted direction and, where there are names, by name.
  const PlacedSightings& undisputed_points(const BearingSet& image, Landmarks landmarks, const PlanarView& view,
                                           bool named);

 private:
  /// A mapped landmark and its predicted bearing.
  struct Visible {
    std::size_t landmark;
    PlanarView::Predicted predicted;
  };

  void begin(const BearingSet& image, const PlanarView& view);
  void associate(const BearingSet& image, Landmarks landmarks, const PlanarView& view, const JointGates& gates);
  void associate_within(Landmarks landmarks, const PlanarView& view, const JointGates& gates);
  bool shows_other_things(const BearingSet& image, Landmarks landmarks) const;
  const PlanarMatches& matches_of_pairings(const BearingSet& image, Landmarks landmarks, const PlanarView& view);
  void predict_visible(Landmarks landmarks, const PlanarView& view, double gate_chi2);
  void add_pair(std::size_t landmark, const Bearing& bearing, Stamp stamp, Landmarks landmarks, const PlanarView& view);
  void gate(const PlanarView& view);
  void gate_individually();
  void gate_jointly(const PlanarView& view);

  EkfSettings settings_;
  JointGates gates_;
  bool jolted_ = false;  ///< The robot turned farther than odometry said before the running image
  JointCompatibility association_;
  JointTest joint_test_;
  PlanarMatches matches_;
  PlacedSightings placed_;

  // State of the running image.
  std::vector<MeasuredAzimuth> measured_;
  std::vector<Visible> visible_;
  std::vector<double> visible_azimuths_rad_;
  std::vector<Kind> visible_kinds_;
  std::vector<Pairing> pairings_;
  std::vector<std::size_t> gated_;
  std::vector<double> innovations_;
  std::vector<std::uint8_t> jointly_accepted_;
  Workspace innovation_covariance_;
};

}  // namespace azimuth
