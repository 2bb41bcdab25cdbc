#pragma once
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
  Pixel pixel = Pixel::Zero();  ///< where its middle is
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();
  LampBlob blob;
};

/// Lamps of a ceiling, all alike: bearings with azimuth and elevation, the standard deviations of both, and nothing
/// that tells one from the other (SPEC II.1).
///
/// Where the rig does not say how large images are, one of another size than the last starts over, at the cost of the
/// tables that depend on it; else it is unreadable.
///
/// Thread contract: as Perception's.
class LampPerception final : public Perception {
 public:
  /// A camera whose model knows elevations (camera_of() gives something); without, nothing is ever found.
  LampPerception(const CameraRig& rig, const LampSettings& settings);

  void observe(const ImageView& image, BearingSet& out) override;

  /// Of the last image, in the order of its bearings.
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
