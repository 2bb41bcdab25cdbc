#pragma once
#include <cstddef>
#include <span>

#include "drivers/camera/frame.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth::sim {

/// Where the simulated camera's images come from.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual FrameFormat format() const = 0;
  virtual Duration period() const = 0;
  /// What the robot's camera sees from `T_world_body`, written into one uncompressed frame of format().
  virtual void render(const Pose2& T_world_body, std::span<std::byte> pixels) = 0;
};

}  // namespace azimuth::sim
