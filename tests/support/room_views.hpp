#pragma once
// Pairs of images of rendered rooms, with the true correspondence of each point of the first image in the second.

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

/// Two images from places of one room at the requested distance, with random headings.
struct RoomPair {
  RoomImage first, second;
  double apart_m = 0.0;
};

/// `count` pairs at distances from `least_m` to `most_m`, with sensor noise. `light` is the brightness of the second
/// image relative to the first.
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

/// Position and scale of a feature in the working square of an image.
struct ImagePlace {
  double x_px = 0.0, y_px = 0.0, sigma_px = 1.0;
};

/// A room with known geometry.
///
/// Thread contract: reentrant.
class KnownRoom {
 public:
  explicit KnownRoom(const RoomPairs& room);

  /// Position and scale in the second image of the point that the first image shows at `place`; no value if the point
  /// is hidden there or outside the image.
  std::optional<ImagePlace> seen_again(const RoomPair& pair, const ImagePlace& place) const;

 private:
  Eigen::Vector3d hit(const Eigen::Vector3d& from, const Eigen::Vector3d& ray) const;
  std::optional<Eigen::Vector2d> moved(const RoomPair& pair, double x_px, double y_px) const;

  RenderScene scene_;
  CameraRig rig_;
  WorkingSquare square_;
};

/// Whether a feature of the second image agrees with the expected place: at most a few pixels (or the scale) away, and
/// of similar scale.
bool is_seen_at(const ImagePlace& expected, const ImagePlace& feature);

}  // namespace azimuth::test
