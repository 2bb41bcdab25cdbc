#pragma once
#include <cstddef>
#include <span>

#include "drivers/camera/frame.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth::sim {

/// Source of the simulated camera's images. Each image is made in short steps, so that the robot's serial line need not
/// wait for it.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual FrameFormat format() const = 0;
  virtual Duration period() const = 0;
  /// Begins the image that the robot's camera sees from `T_world_body`.
  virtual void begin(const Pose2& T_world_body) = 0;
  /// Continues for about a millisecond; returns true when the image is complete. `pixels` must be the same uncompressed
  /// frame of format() in all steps of an image.
  virtual bool step(std::span<std::byte> pixels) = 0;
};

}  // namespace azimuth::sim
