#pragma once
// Pairs of images of rendered rooms, and where in the second each point of the first is seen again, which only the
// renderer can know.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/renderer/render_scene.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/perception/image/working_image.hpp"
#include "slam/sample/image.hpp"

namespace azimuth::test {

struct RoomImage {
  Pose2 T_world_body;
  FrameFormat format;
  std::vector<std::byte> bytes;
  ImageView view() const { return {format, bytes}; }
};

/// Two images from places of one room that are apart by what was asked for, with any headings.
struct RoomPair {
  RoomImage first, second;
  double apart_m = 0.0;
};

/// `count` pairs from `least_m` to `most_m` apart, with a sensor's noise. `light` of the second, times the first's.
struct RoomPairs {
  CameraRig rig;
  RenderScene scene;
  std::vector<RoomPair> pairs;
};
struct RoomPairSettings {
  int count = 24;
  double least_m = 0.2, most_m = 2.0, noise = 1.5, light = 1.0;
};
RoomPairs room_pairs(std::uint64_t seed, const RoomPairSettings& settings);

/// A feature of the working square of an image.
struct ImagePlace {
  double x_px = 0.0, y_px = 0.0, sigma_px = 1.0;
};

/// Of which all is known.
///
/// Thread contract: reentrant.
class KnownRoom {
 public:
  explicit KnownRoom(const RoomPairs& room);

  /// Where in the second image what is at `place` of the first is, how large it is there; nothing: it is hidden there,
  /// or beyond the image's edge.
  std::optional<ImagePlace> seen_again(const RoomPair& pair, const ImagePlace& place) const;

 private:
  Eigen::Vector3d hit(const Eigen::Vector3d& from, const Eigen::Vector3d& ray) const;
  std::optional<Eigen::Vector2d> moved(const RoomPair& pair, double x_px, double y_px) const;

  RenderScene scene_;
  CameraRig rig_;
  WorkingSquare square_;
};

/// Whether a feature of the second image is what is expected there: a few pixels away, or its scale, and about as
/// large.
bool is_seen_at(const ImagePlace& expected, const ImagePlace& feature);

}  // namespace azimuth::test
