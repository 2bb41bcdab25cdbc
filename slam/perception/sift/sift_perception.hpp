#pragma once
#include <memory>
#include <optional>

#include "slam/camera/camera_model.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/perception/image/visible_region.hpp"
#include "slam/perception/image/working_image.hpp"
#include "slam/perception/perception.hpp"
#include "slam/perception/sift/feature_finder.hpp"
#include "slam/perception/sift/selection.hpp"
#include "slam/perception/sift/sift_settings.hpp"

namespace azimuth {

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
