#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/estimator/rig.hpp"
#include "slam/localisation/relocaliser.hpp"
#include "slam/lost/agreement_watch.hpp"
#include "slam/lost/seen_again.hpp"
#include "slam/planar/ekf_settings.hpp"
#include "slam/planar/planar_landmark.hpp"
#include "slam/planar/planar_view.hpp"

namespace azimuth {

/// What noticing that the robot is lost, and searching for it, need to know of the planar map (lost_robot.hpp).
///
/// What is returned by reference stands until the next call. Thread contract: thread-bound.
class PlanarSearch {
 public:
  using Landmarks = std::span<const PlanarLandmark>;

  PlanarSearch(const Rig& rig, const EkfSettings& settings);

  /// What was seen a moment ago and is in view still, and how much of the image is where it should be. `in_doubt`:
  /// whether the images before speak against the pose.
  ImageAgreement agreement(const BearingSet& image, Landmarks landmarks, const PlanarView& view, double path_m,
                           bool in_doubt);

  /// Likewise of features, of which an image shows but some: by how often such are seen again.
  ImageAgreement agreement_of_features(const BearingSet& image, Landmarks landmarks, const PlanarView& view,
                                       double path_m, bool in_doubt);
  /// The robot is elsewhere than it was thought to be: no image is to be compared with those before.
  void forget_images() { seen_again_.forget_images(); }

  /// A landmark was recognised so far away: how far the camera sees, as experience says.
  void note_range(double distance_m);
  /// Nearer than that are 19 of 20 of the landmarks it sees.
  double usual_range_m() const { return usual_range_m_; }
  /// Farther than that nothing is seen that an image could show: where landmarks only look like others, and once
  /// enough of them have been recognised; else there is no such limit.
  double reach_m() const;

  static std::vector<KnownLandmark> known(Landmarks landmarks, const JointState& state);
  CameraView camera_view(const BearingEkf& ekf) const;
  /// The image's directions for a search, those under names of ours that are not in the map left out.
  std::span<const SeenDirection> directions(const BearingSet& image, Landmarks landmarks, const BearingEkf& ekf);

 private:
  /// Where a landmark should be in the image.
  struct Prediction {
    const PlanarLandmark* landmark;
    double azimuth_rad, gate_rad;
    bool due;
    bool apart;  ///< from all others
  };
  static Prediction prediction_of(const PlanarLandmark& landmark, const PlanarView::Predicted& predicted, bool due);
  /// Under its name, where it should be.
  static bool shows_there(const BearingSet& image, const Prediction& prediction);
  enum class Explained : std::uint8_t { not_at_all, by_one_beside_another, by_one_apart };
  bool is_established(const PlanarLandmark& landmark) const;
  bool is_due(const PlanarLandmark& landmark, const BearingSet& image, double path_m) const;
  bool was_in_one_of_the_last(const PlanarLandmark& landmark) const;
  bool is_in_range(const PlanarLandmark& landmark, const JointState& state) const;
  bool is_in_view(const Prediction& prediction) const;
  /// Of what is established, and may be in the image.
  void predict(const BearingSet& image, Landmarks landmarks, const PlanarView& view, double path_m);
  void tell_apart();
  void mark_explained(const BearingSet& image, const Prediction& prediction);

  Rig rig_;
  EkfSettings settings_;
  bool named_, by_looks_;
  double seen_range_m_ = 0.0;  ///< of the farthest landmark seen lately
  int recognised_ = 0;
  double usual_range_m_ = 0.0;  ///< see usual_range_m()
  /// Of the last images from before any doubt, in turn.
  static constexpr std::size_t kLastImages = 8;
  std::array<Stamp, kLastImages> last_images_{};
  std::size_t images_ = 0;
  SeenAgain seen_again_;
  std::vector<Look> looks_;
  std::vector<Prediction> predictions_;
  std::vector<Explained> explained_;  ///< the image's bearings, by landmarks where they should be
  std::vector<SeenDirection> directions_;
};

}  // namespace azimuth
