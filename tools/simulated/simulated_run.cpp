#include "tools/simulated/simulated_run.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <utility>
#include <vector>

#include "drivers/camera/jpeg.hpp"
#include "sim/renderer/renderer.hpp"
#include "sim/renderer/standard_cameras.hpp"
#include "sim/world/run_of.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;

constexpr double kLampHeight_m = 6.5;
constexpr double kTruthPeriod_s = 0.02;  // fine enough to interpolate the pose at each image

struct Studio {
  RenderScene scene;
  RenderCamera camera;
  std::string rig_toml;
};

FileResult<Studio> studio_of(const Scenario& scenario, const RenderSettings& settings) {
  std::optional<CameraRig> rig = standard_camera(settings.camera);
  if (!rig) return failure(FileError{settings.camera, 0, "is no camera that can be simulated"});
  if (settings.size != 1.0) rig = scaled(*rig, settings.size);
  rig->yaw_offset_rad = scenario.sensor.yaw_offset_rad;
  rig->roll_rad = settings.roll_rad;
  rig->pitch_rad = settings.pitch_rad;
  std::string problem;
  std::optional<RenderCamera> camera = render_camera_of(*rig, problem);
  if (!camera) return failure(FileError{settings.camera, 0, problem});
  camera->sensor = {.noise = settings.noise,
                    .vignetting = 0.25,
                    .vignetting_radius_px = rig->image.mask_outer_px.value_or(camera->width_px),
                    .seed = scenario.seed};
  const bool lamps = settings.camera == "fisheye";
  RenderScene scene = lamps ? lamp_scene(scenario, kLampHeight_m) : coloured_scene(scenario);
  if (const auto misfit = Renderer::problem(scene, *camera))
    return failure(FileError{settings.camera, 0, std::string(*misfit)});
  return Studio{std::move(scene), *std::move(camera), rig_toml(scenario, image_camera_toml(*rig))};
}

Pose2 true_pose(const std::vector<TruthPose>& truth, Stamp stamp) {
  const auto after = std::ranges::lower_bound(truth, stamp, {}, &TruthPose::stamp);
  if (after == truth.end()) return truth.back().T_world_body;
  if (after == truth.begin() || after->stamp == stamp) return after->T_world_body;
  const TruthPose& before = *(after - 1);
  const double fraction = to_seconds(stamp - before.stamp) / to_seconds(after->stamp - before.stamp);
  return interpolate(before.T_world_body, after->T_world_body, fraction);
}

/// Renders and encodes the images of a drive.
class Photographer {
 public:
  Photographer(const Studio& studio, int quality)
      : renderer_(studio.scene, studio.camera),
        format_(packed_format(PixelFormat::rgb8, studio.camera.width_px, studio.camera.height_px)),
        pixels_(format_.bytes()),
        quality_(quality) {}

  FileResult<void> take(const Pose2& T_world_body, const fs::path& file) {
    renderer_.render(T_world_body, {format_, pixels_});
    const auto jpeg = encoder_.encode({format_, pixels_}, quality_);
    std::ofstream stream(file, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(jpeg.data()), static_cast<std::streamsize>(jpeg.size()));
    stream.close();
    if (!stream) return failure(FileError{file.string(), 0, std::string("cannot be written: ") + std::strerror(errno)});
    return {};
  }

 private:
  Renderer renderer_;
  JpegEncoder encoder_;
  FrameFormat format_;
  std::vector<std::byte> pixels_;
  int quality_;
};

FileResult<void> take_frames(const Studio& studio, const RenderSettings& settings, Run& run, const Progress& progress) {
  std::error_code error;
  fs::create_directories(run.folder / "frames", error);
  if (error) return failure(FileError{(run.folder / "frames").string(), 0, "cannot be made: " + error.message()});
  Photographer photographer(studio, settings.quality);
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const FrameFile& frame = run.frames[i];
    auto taken = photographer.take(true_pose(run.truth, frame.stamp), run.folder / frame.file);
    if (!taken) return taken;
    if (progress) progress(i + 1, run.frames.size());
  }
  return {};
}

}  // namespace

Run simulated_run(const Scenario& scenario) {
  World world = simulate(scenario);
  Run run = run_of(scenario);
  run.rig_file = "rig.toml";
  run.odometry = std::move(world.odometry);
  run.bearings = std::move(world.bearings);
  for (const TruePose& pose : world.truth) run.truth.push_back({pose.stamp, pose.T_world_body});
  return run;
}

Run first_seconds(Run run, double most_s) {
  if (run.odometry.empty() || !std::isfinite(most_s)) return run;
  const Stamp begin = run.odometry.front().stamp;
  const auto shorten = [&](auto& samples) {
    std::erase_if(samples, [&](const auto& sample) { return to_seconds(sample.stamp - begin) > most_s; });
  };
  shorten(run.odometry);
  shorten(run.bearings);
  shorten(run.truth);
  return run;
}

FileResult<Run> rendered_run(const Scenario& scenario, const RenderSettings& settings, const fs::path& folder,
                             double most_s, const Progress& progress) {
  FileResult<Studio> studio = studio_of(scenario, settings);
  if (!studio) return failure(studio.error());
  Scenario dense = scenario;
  dense.sampling.truth_period_s = kTruthPeriod_s;
  Run run = first_seconds(simulated_run(dense), most_s);
  run.folder = folder;
  run.rig_toml = std::move(studio->rig_toml);
  for (const BearingSet& set : run.bearings)
    run.frames.push_back({set.stamp, fmt::format("frames/{:06}.jpg", run.frames.size())});
  run.bearings.clear();
  if (auto taken = take_frames(*studio, settings, run, progress); !taken) return failure(taken.error());
  return run;
}

}  // namespace azimuth
