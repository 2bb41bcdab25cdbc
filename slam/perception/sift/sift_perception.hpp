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

/// Features of a room seen through a mirror or fisheye (SPEC I.12): bearings with descriptors and neighbours, and with
/// elevations where the rig's model of the camera knows them. Identities are for others to find.
///
/// Where the rig does not say how large images are, one of another size than the last starts over, at the cost of the
/// tables that depend on it; else it is unreadable.
///
/// Thread contract: as Perception's.
class SiftPerception final : public Perception {
 public:
  SiftPerception(const CameraRig& rig, const SiftSettings& settings);

  void observe(const ImageView& image, BearingSet& out) override;

  /// Of the last image, in the order of its bearings, in the working image.
  const std::vector<KeyPoint>& key_points() const { return key_points_; }
  const WorkingSquare& working_square() const { return square_; }
  const Plane<std::uint16_t>& working_image() const { return image_; }

 private:
  /// What depends on the size of the camera's images.
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
