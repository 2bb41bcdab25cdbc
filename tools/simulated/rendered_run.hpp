#pragma once
#include <filesystem>
#include <limits>
#include <string>

#include "base/file_result.hpp"
#include "base/progress.hpp"
#include "drivers/storage/run.hpp"
#include "sim/world/scenario.hpp"

namespace azimuth {

struct RenderSettings {
  std::string camera = "mirror";           ///< of standard_camera()
  double size = 1.0;                       ///< of the image, times the camera's
  double roll_rad = 0.0, pitch_rad = 0.0;  ///< how the camera leans; its rig says so
  double noise = 1.5;                      ///< standard deviation of each sample, of 256 steps
  int quality = 90;                        ///< of the JPEG files
};

/// Drives through the scenario with an image camera in place of its bearing sensor, at the same instants. Writes the
/// images below `folder`, made if need be, each before the next is rendered; the tables are the caller's to write.
/// Refuses a camera that is not known or does not fit the scenario's room, and a folder that cannot be written.
/// `most_s`: see first_seconds().
FileResult<Run> rendered_run(const Scenario& scenario, const RenderSettings& settings,
                             const std::filesystem::path& folder,
                             double most_s = std::numeric_limits<double>::infinity(), const Progress& progress = {});

}  // namespace azimuth
