#pragma once
#include <filesystem>
#include <limits>
#include <string>

#include "base/file_result.hpp"
#include "base/progress.hpp"
#include "drivers/storage/run.hpp"
#include "sim/world/scenario.hpp"
#include "sim/world/simulate.hpp"

namespace azimuth {

/// Simulates the scenario and returns the run that a robot would have recorded.
Run simulated_run(const Scenario& scenario);

/// The part of the run within `most_s` seconds of the first odometry reading.
Run first_seconds(Run run, double most_s);

struct RenderSettings {
  std::string camera = "mirror";           ///< name for standard_camera()
  double size = 1.0;                       ///< scale factor of the image size
  double roll_rad = 0.0, pitch_rad = 0.0;  ///< tilt of the camera, also written to the rig
  double noise = 1.5;                      ///< standard deviation of each sample, in grey levels of 0 to 255
  int quality = 90;                        ///< quality of the JPEG files
};

/// Simulates the scenario with an image camera in place of the bearing sensor, at the same instants. Writes each image
/// below `folder`, which is created if necessary, before it renders the next one. The caller writes the tables of the
/// run. Fails if the camera is unknown or does not fit the scenario's room, or if the folder is not writable. `most_s`:
/// see first_seconds().
FileResult<Run> rendered_run(const Scenario& scenario, const RenderSettings& settings,
                             const std::filesystem::path& folder,
                             double most_s = std::numeric_limits<double>::infinity(), const Progress& progress = {});

}  // namespace azimuth
