#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "slam/camera/camera_model.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/perception/image/visible_region.hpp"
#include "slam/perception/image/working_image.hpp"
#include "slam/perception/perception.hpp"
#include "slam/perception/sift/feature_finder.hpp"
#include "slam/perception/sift/sift_settings.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Selects the features of an image. Strong key points are preferred, since they are found again. They must come from
/// all around the robot, since bearings from one side constrain its position poorly.
///
/// From the strongest to the weakest, a key point is chosen unless the sector of azimuths centred on it already holds
/// its share of the target count. Remaining places go to the strongest of the other key points. Sectors are centred on
/// each key point and not fixed in the image, so the choice does not depend on the robot's heading, nor on the order of
/// the key points.
///
/// Thread contract: thread-bound. Nothing allocates in the steady state.
class FeatureSelection {
 public:
  /// `centre_px`: coordinate of the optical axis in the working image, the same along x and y.
  FeatureSelection(const SiftSettings& settings, double centre_px);

  /// Keeps at most target_count key points, strongest first.
  void select(std::vector<KeyPoint>& key_points);

 private:
  struct Candidate {
    KeyPoint point;
    float azimuth_rad = 0.0F;  ///< In the image
  };

  void order(const std::vector<KeyPoint>& key_points);
  bool has_room(const Candidate& candidate) const;

  std::size_t target_count_, share_;
  float half_sector_rad_, centre_px_;
  std::vector<Candidate> candidates_, chosen_, left_over_;
};

/// Finds for each key point the Neighbours::kMost nearest others by Manhattan distance in the image, nearest first
/// (mathematics I.14). Of equally near key points, the one with the smaller index comes first. At most 65535 key
/// points.
///
/// Thread contract: reentrant. Nothing allocates once `out` has grown.
void find_neighbours(std::span<const KeyPoint> key_points, std::vector<Neighbours>& out);

/// Finds features of a room seen through a mirror or fisheye lens (mathematics I.12). The bearings have descriptors and
/// neighbours, and elevations if the rig's camera model knows them. Identities are assigned later, by data association.
///
/// If the rig does not give the image size, an image of a new size makes this class rebuild the tables that depend on
/// the size. If the rig gives the size, an image of another size is unreadable.
///
/// Thread contract: that of Perception.
class SiftPerception final : public Perception {
 public:
  SiftPerception(const CameraRig& rig, const SiftSettings& settings);

  void observe(const ImageView& image, BearingSet& out) override;

  /// The key points of the last image in the working image, in the order of its bearings.
  const std::vector<KeyPoint>& key_points() const { return key_points_; }
  const WorkingSquare& working_square() const { return square_; }
  const Plane<std::uint16_t>& working_image() const { return image_; }

 private:
  /// The parts that depend on the size of the camera's images.
  struct Layout {
    WorkingImage image;
    VisibleRegion region;
    FeatureSelection selection;
  };

  void lay_out(int width_px, int height_px);
  Bearing bearing(const KeyPoint& point) const;

  CameraRig rig_;
  SiftSettings settings_;
  std::optional<CameraModel> camera_;
  WorkingSquare square_;
  std::optional<Layout> layout_;
  std::unique_ptr<FeatureFinder> finder_;
  Plane<std::uint16_t> image_;
  std::vector<KeyPoint> key_points_;
};

}  // namespace azimuth
