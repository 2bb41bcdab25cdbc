#pragma once
#include <cstddef>
#include <span>

#include "drivers/camera/frame.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth::sim {

/// Where the simulated camera's images come from. Each is made in short steps, since the robot's serial line must not
/// wait for an image.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual FrameFormat format() const = 0;
  virtual Duration period() const = 0;
  /// Begins with what the robot's camera sees from `T_world_body`.
  virtual void begin(const Pose2& T_world_body) = 0;
  /// Goes on for about a millisecond, into the same uncompressed frame of format() each time; true when it is whole.
  virtual bool step(std::span<std::byte> pixels) = 0;
};

}  // namespace azimuth::sim
