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

/// What the bearings of an image are of.
struct PlanarMatches {
  /// A bearing paired with a mapped landmark.
  struct Pair {
    std::size_t landmark;
    MappedSighting sighting;
    ObservationRow row;
    double variance_rad2;  ///< S = H P H^T + R
    bool accepted = true;  ///< by its own gate and by the joint one
  };
  std::vector<Pair> pairs;
  std::vector<Bearing> unmapped;  ///< of something that is not in the map
  std::uint64_t repeated = 0;     ///< have the name of an earlier bearing of the same image, so it is not theirs
  std::uint64_t ambiguous = 0;    ///< left alone: a rival hypothesis explains them otherwise
  std::uint64_t thinned = 0;      ///< left alone: too soon after the last one of the same landmark

  std::size_t rejected() const;
  void clear() {
    pairs.clear();
    unmapped.clear();
    repeated = ambiguous = thinned = 0;
  }
};

/// Mapped points of an image that place the robot.
struct PlacedSightings {
  std::vector<MappedSighting> sightings;
  std::vector<std::size_t> landmarks;  ///< of each

  void clear() {
    sightings.clear();
    landmarks.clear();
  }
  void add(std::size_t landmark, const MappedSighting& sighting) {
    sightings.push_back(sighting);
    landmarks.push_back(landmark);
  }
};

/// Which bearing belongs to which mapped landmark, and which pairings are believed.
///
/// What is returned stands until the next call. Thread contract: thread-bound; does not allocate once its workspace has
/// grown to the largest image.
class PlanarMatcher {
 public:
  using Landmarks = std::span<const PlanarLandmark>;

  PlanarMatcher(const EkfSettings& settings, double new_density_per_rad);

  /// A name stands for one landmark; bearings without are not used.
  const PlanarMatches& match_names(const BearingSet& image, Landmarks landmarks, const PlanarView& view);
  /// A bearing belongs to the landmark that the likeliest joint hypothesis gives it, is of something new when that
  /// hypothesis says so, and is left alone when a rival hypothesis says otherwise.
  const PlanarMatches& match_places(const BearingSet& image, Landmarks landmarks, const PlanarView& view);

  /// The joint hypotheses that match_places() chooses from, those far less likely than the best left out. They are
  /// looked for with less effort, as many filters do so at once.
  const JointCompatibility& weigh(const BearingSet& image, Landmarks landmarks, const PlanarView& view,
                                  double keep_log_ratio);
  /// The matches by one of them, of the same image, landmarks and view.
  const PlanarMatches& match_weighed(const BearingSet& image, Landmarks landmarks, const PlanarView& view,
                                     std::size_t hypothesis);

  /// The named bearings of mapped points, gated or not.
  const PlacedSightings& named_points(const BearingSet& image, Landmarks landmarks, const PlanarView& view);
  /// Bearings that are of one point and of no other, by where it should be, and by its name where there are names.
  const PlacedSightings& undisputed_points(const BearingSet& image, Landmarks landmarks, const PlanarView& view,
                                           bool named);

 private:
  /// A mapped landmark as the camera should see it.
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
  bool jolted_ = false;  ///< the running image is one of a robot that turned farther than it should have
  JointCompatibility association_;
  JointTest joint_test_;
  PlanarMatches matches_;
  PlacedSightings placed_;

  // Of the running image.
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
