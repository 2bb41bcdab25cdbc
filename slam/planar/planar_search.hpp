#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/estimator/rig.hpp"
#include "slam/localisation/relocaliser.hpp"
#include "slam/lost/lost_robot.hpp"
#include "slam/lost/seen_again.hpp"
#include "slam/planar/ekf_settings.hpp"
#include "slam/planar/planar_landmark.hpp"
#include "slam/planar/planar_view.hpp"

namespace azimuth {

/// Detection that the robot is lost, and input of the search for it, for the planar map (lost_robot.hpp).
///
/// Returned references are valid until the next call. Thread contract: thread-bound.
class PlanarSearch {
 public:
  using Landmarks = std::span<const PlanarLandmark>;

  PlanarSearch(const Rig& rig, const EkfSettings& settings, const RelocalisationSettings& relocalisation);

  /// How many of the landmarks that were seen a moment ago and are still in view are where they should be in the image.
  /// `in_doubt`: the previous images speak against the pose.
  ImageAgreement agreement(const BearingSet& image, Landmarks landmarks, const PlanarView& view, double path_m,
                           bool in_doubt);

  /// Variant for features. An image shows only some of the features in view, so the agreement is judged by how often
  /// such features are seen again.
  ImageAgreement agreement_of_features(const BearingSet& image, Landmarks landmarks, const PlanarView& view,
                                       double path_m, bool in_doubt);
  /// The robot's pose was found anew: previous images are not comparable with the next ones.
  void forget_images() { seen_again_.forget_images(); }

  /// A landmark was recognised at this distance; from such distances the camera's usual range is learned.
  void note_range(double distance_m);
  /// 19 of 20 landmarks that the camera recognises are nearer than this.
  double usual_range_m() const { return usual_range_m_; }
  /// Distance beyond which a landmark cannot be associated. It is finite only where landmarks are told apart by colour
  /// and once enough of them have been recognised.
  double reach_m() const;

  static std::vector<KnownLandmark> known(Landmarks landmarks, const JointState& state);
  CameraView camera_view(const BearingEkf& ekf) const;
  /// The image's directions for a search. Features whose identity is not in the map are left out.
  std::span<const SeenDirection> directions(const BearingSet& image, Landmarks landmarks, const BearingEkf& ekf);

 private:
  /// The predicted bearing of a landmark.
  struct Prediction {
    const PlanarLandmark* landmark;
    double azimuth_rad, gate_rad;
    bool due;
    bool apart;  ///< No other landmark is near in direction
  };
  static Prediction prediction_of(const PlanarLandmark& landmark, const PlanarView::Predicted& predicted, bool due);
  /// Whether the image has a bearing with the landmark's identity in the predicted direction.
  static bool shows_there(const BearingSet& image, const Prediction& prediction);
  enum class Explained : std::uint8_t { not_at_all, by_one_beside_another, by_one_apart };
  bool is_established(const PlanarLandmark& landmark) const;
  bool is_due(const PlanarLandmark& landmark, const BearingSet& image, double path_m) const;
  bool was_in_one_of_the_last(const PlanarLandmark& landmark) const;
  bool is_in_range(const PlanarLandmark& landmark, const JointState& state) const;
  bool is_in_view(const Prediction& prediction) const;
  /// Predicts the established landmarks that may be in the image.
  void predict(const BearingSet& image, Landmarks landmarks, const PlanarView& view, double path_m);
  void tell_apart();
  void mark_explained(const BearingSet& image, const Prediction& prediction);

  Rig rig_;
  EkfSettings settings_;
  double detection_probability_;  ///< detection probability in a search, see RelocalisationSettings
  bool named_, by_looks_;
  double seen_range_m_ = 0.0;  ///< Distance of the farthest landmark recognised lately, slowly decaying
  int recognised_ = 0;
  double usual_range_m_ = 0.0;  ///< See usual_range_m()
  /// Ring of the stamps of the last images taken while there was no doubt.
  static constexpr std::size_t kLastImages = 8;
  std::array<Stamp, kLastImages> last_images_{};
  std::size_t images_ = 0;
  SeenAgain seen_again_;
  std::vector<Look> looks_;
  std::vector<Prediction> predictions_;
  std::vector<Explained> explained_;  ///< Whether landmarks explain each bearing of the image
  std::vector<SeenDirection> directions_;
};

}  // namespace azimuth
