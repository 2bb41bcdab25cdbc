#pragma once
// azimuth calibrate mirror, for those that go on from its rig.

#include <filesystem>

#include "slam/estimator/rig.hpp"

namespace azimuth {

/// Of a run whose images show a mirror, printing what is found unless `quiet`: the heading up in the image, the front
/// end by what is seen again. Refuses and fails as the command does.
Rig rig_by_mirror(const std::filesystem::path& run, bool quiet);

}  // namespace azimuth
