#include "tests/support/rendered_drive.hpp"

#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "settings/rig.hpp"
#include "slam/perception/make_perception.hpp"
#include "tools/replay/set_source.hpp"

namespace azimuth::test {

RenderedDrive::RenderedDrive(const Scenario& scenario, const RenderSettings& settings, double most_s) {
  FileResult<Run> rendered = rendered_run(scenario, settings, folder_.path(), most_s);
  if (rendered)
    run_ = *std::move(rendered);
  else
    ADD_FAILURE() << text(rendered.error());
}

Rig RenderedDrive::rig() const { return read_rig(run_.rig_toml, "rig.toml").value(); }

Run RenderedDrive::seen_by(const Rig& rig) const {
  Run run = run_;
  SeenSets images(run, rig.camera.image,
                  {make_perception(rig.front_end, rig.camera, {}), decoded_format(rig.front_end)});
  std::vector<BearingSet> seen(images.count());
  for (BearingSet& set : seen) EXPECT_TRUE(images.next(set));
  run.frames.clear();
  run.bearings = std::move(seen);
  return run;
}

}  // namespace azimuth::test
