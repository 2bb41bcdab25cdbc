#pragma once
// A drive with an image camera, and what its front end sees.

#include "drivers/storage/run.hpp"
#include "sim/world/scenario.hpp"
#include "slam/estimator/rig.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/simulated/rendered_run.hpp"

namespace azimuth::test {

/// Images are in a folder that lives as long as this does. Fails the test when they cannot be made.
class RenderedDrive {
 public:
  RenderedDrive(const Scenario& scenario, const RenderSettings& settings, double most_s);

  /// That of the camera that took them.
  Rig rig() const;
  /// With bearings in place of images, none of a named landmark, as somebody sees them who believes in `rig`.
  Run seen_by(const Rig& rig) const;
  Run seen() const { return seen_by(rig()); }

 private:
  TemporaryFolder folder_;
  Run run_;
};

}  // namespace azimuth::test
