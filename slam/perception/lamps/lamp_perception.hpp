#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "slam/camera/camera_model.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/camera/direction_table.hpp"
#include "slam/perception/image/plane.hpp"
#include "slam/perception/lamps/lamp_finder.hpp"
#include "slam/perception/lamps/lamp_settings.hpp"
#include "slam/perception/perception.hpp"

namespace azimuth {

/// A lamp in the image.
struct DetectedLamp {
  Pixel pixel = Pixel::Zero();  ///< The image of the lamp's centre
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();
  LampBlob blob;
};

/// An image spot interpreted as a patch of light in a horizontal ceiling. Lengths are in units of the ceiling's height
/// above the camera.
struct CeilingPatch {
  Pixel middle = Pixel::Zero();  ///< the image of the patch's middle
  double length_heights = 0.0;   ///< Length of the rectangle with the same second moments
  double area_heights2 = 0.0;    ///< Area of that rectangle
};

/// Computes the ceiling patch behind a spot with the given centroid and pixel covariance. Returns nullopt if parts of
/// the spot are not above the horizon or lie outside the camera's field of view.
///
/// The image of a lamp's centre differs from the centroid of the lamp's image, because the nearer part of the lamp
/// appears larger: for a lamp of 1.2 m at 4 m distance the difference is one pixel. The spot is therefore mapped to the
/// ceiling at four points with the moments of the spot, each weighted by the ceiling area that one pixel covers there.
/// This is exact to third order.
///
/// Thread contract: reentrant. Nothing allocates.
std::optional<CeilingPatch> ceiling_patch(const CameraModel& camera, const Pixel& centroid,
                                          const Eigen::Matrix2d& spread_px2);

/// Finds ceiling lamps, which all look alike. The bearings have azimuth and elevation, the standard deviations of both,
/// and no identity (mathematics II.1).
///
/// If the rig does not give the image size, an image of a new size makes this class rebuild the tables that depend on
/// the size. If the rig gives the size, an image of another size is unreadable.
///
/// Thread contract: that of Perception.
class LampPerception final : public Perception {
 public:
  /// The rig must have a camera model that knows elevations (camera_of() returns a model). Without one, no lamp is ever
  /// found.
  LampPerception(const CameraRig& rig, const LampSettings& settings);

  void observe(const ImageView& image, BearingSet& out) override;

  /// The lamps of the last image, in the order of its bearings.
  const std::vector<DetectedLamp>& lamps() const { return lamps_; }
  const Light& light() const { return finder_.light(); }

 private:
  void lay_out(int width_px, int height_px);
  GrayView gray(const ImageView& image);
  std::optional<DetectedLamp> lamp(const LampBlob& blob) const;
  Eigen::Matrix2d covariance_px2(const LampBlob& blob) const;
  std::optional<Bearing> bearing(const DetectedLamp& lamp) const;

  CameraRig rig_;
  LampSettings settings_;
  double sigma_place_px_;
  std::optional<CameraModel> camera_;
  std::optional<DirectionTable> table_;
  VisibleRows visible_;
  Plane<std::uint8_t> gray_;
  LampFinder finder_;
  std::vector<LampBlob> blobs_;
  std::vector<DetectedLamp> lamps_;
};

}  // namespace azimuth
