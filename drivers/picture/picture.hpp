#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/picture/canvas.hpp"
#include "slam/camera/camera_model.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/camera/image_mask.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// Places names round a mirror's rim, each as near to its azimuth as the space beside the other names permits.
///
/// Thread contract: thread-bound. Storage is kept from picture to picture.
class RimNames {
 public:
  struct Name {
    double azimuth_rad = 0.0;  ///< The azimuth of the landmark
    std::string text;
    PictureColour colour{};
    double placed_rad = 0.0;  ///< The azimuth at which the name is written
  };

  void clear() { names_.clear(); }
  void add(double azimuth_rad, std::string text, const PictureColour& colour);

  /// Moves the names apart so that they do not overlap. If there is not room for all, they share the rim evenly.
  const std::vector<Name>& placed(double radius_px);

 private:
  void begin_after_the_widest_gap();

  std::vector<Name> names_;
};

/// Draws the detections of an image and the expected bearings. It shows the outlines of the mask. Each bearing is a
/// radial line in the colour of its kind or, if its elevation determines its pixel, a circle. Each expected landmark
/// has its number outside the rim at the expected azimuth, with its gate as an arc; if an elevation is expected too, it
/// is a cross at the expected pixel inside the outline of the gate. Bearings in no gate are magenta.
///
/// The picture is for people; its appearance may change.
///
/// Thread contract: thread-bound. Same input, same bytes.
class Picture {
 public:
  explicit Picture(const CameraRig& rig);

  /// Returns the picture in rgb8, larger than the image by Canvas::kMargin_px on each side; valid until the next call.
  /// An image that is not readable is drawn black. `expected` holds the estimator's expectation before it used `seen`.
  /// `in_map` holds the ids of the map's landmarks in ascending order: if given, landmarks are named by their index in
  /// it, from 1, and landmarks not in it have no name; otherwise they are named by their ids.
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

  int width_px_, height_px_;  // Size of the black image that stands in for an image that is not readable
  ImageAxes axes_;
  MaskShape mask_;
  std::optional<CameraModel> model_;
  double rim_px_ = 0.0;
  std::optional<std::span<const std::int64_t>> in_map_;  // Of the current picture
  RimNames rim_names_;
  std::vector<Eigen::AlignedBox2d> written_;  // Positions of the names inside the image
  Canvas canvas_;
};

}  // namespace azimuth
