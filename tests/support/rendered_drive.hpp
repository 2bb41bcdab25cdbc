#pragma once
// A drive with a rendered camera, and the bearings of its front end.

#include "drivers/storage/run.hpp"
#include "sim/world/scenario.hpp"
#include "slam/estimator/rig.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth::test {

/// The images are in a temporary folder with the lifetime of this object. The test fails if they cannot be rendered.
class RenderedDrive {
 public:
  RenderedDrive(const Scenario& scenario, const RenderSettings& settings, double most_s);

  /// The rig of the camera that took the images.
  Rig rig() const;
  /// The run with bearings in place of images, without names. The front end assumes the camera of `rig`.
  Run seen_by(const Rig& rig) const;
  Run seen() const { return seen_by(rig()); }

 private:
  TemporaryFolder folder_;
  Run run_;
};

}  // namespace azimuth::test
