#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "picture/canvas.hpp"
#include "picture/rim_names.hpp"
#include "slam/camera/camera_model.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/camera/image_mask.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/expected_bearing.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// Draws what was seen in an image and what was expected: the mask's outlines; for each bearing a radial line in the
/// colour of its kind or, where its elevation tells the place in the image, a circle; outside the rim each mapped
/// landmark's number at its expected azimuth with its gate as an arc or, where an elevation is expected as well, a
/// cross at the place in the image, in the gate's outline. Bearings in nobody's gate stand out in magenta.
///
/// For people: nothing is measured in it, and its look may change.
///
/// Thread contract: thread-bound. Same input, same bytes.
class Picture {
 public:
  explicit Picture(const CameraRig& rig);

  /// The picture in rgb8, larger than the image by Canvas::kMargin_px on each side; valid until the next call. An image
  /// that is not readable is left black. `expected` is what the estimator expected before it used `seen`. With
  /// `in_map`, the ids of the map's landmarks, rising, landmarks are called by their place among these, from 1 on, and
  /// those that are not in the map have no name; without it by their ids.
  ImageView draw(const ImageView& image, const BearingSet& seen, std::span<const ExpectedBearing> expected,
                 std::optional<std::span<const std::int64_t>> in_map = std::nullopt);

 private:
  void draw_mask();
  void draw_expected(const ExpectedBearing& expected);
  bool draw_gate(const ExpectedBearing& expected);
  void draw_seen(const Bearing& bearing, bool is_expected);
  void draw_ring(double radius_px);
  void draw_arc(double radius_px, double from_rad, double to_rad, const PictureColour& colour, int thickness_px);
  std::string name_of(const ExpectedBearing& expected) const;
  void write_rim_names();
  void write_where_free(std::initializer_list<Pixel> middles, const std::string& text, const PictureColour& colour);
  void write_captions(const BearingSet& seen, std::size_t expected_seen, std::size_t expected);
  Pixel at(double radius_px, double azimuth_rad) const;

  int width_px_, height_px_;  // of a picture without an image
  ImageAxes axes_;
  MaskShape mask_;
  std::optional<CameraModel> model_;
  double rim_px_ = 0.0;
  std::optional<std::span<const std::int64_t>> in_map_;  // of the picture that is being drawn
  RimNames rim_names_;
  std::vector<Eigen::AlignedBox2d> written_;  // where names stand within the image
  Canvas canvas_;
};

}  // namespace azimuth
