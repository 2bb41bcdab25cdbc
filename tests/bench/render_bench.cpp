// Time to render one frame of 1024 x 768. It must stay well below the 67 ms between images of a camera at 15 Hz.

#include <benchmark/benchmark.h>

#include "sim/renderer/renderer.hpp"

namespace azimuth {
namespace {

const ImageAxes kAxes{{512.0, 384.0}, 1.0, -1, -kPi / 2};

RenderCamera mirror_camera() {
  return {.model = CameraModel(kAxes, HyperbolicMirror{28.095, 23.4125, 1035.376}),
          .mask = {60.0, 376.0, {}},
          .height_m = 1.0,
          .T_body_camera = {},
          .sensor = {1.5, 0.3, 376.0, 1}};
}

RenderCamera fisheye_camera() {
  RenderCamera camera = mirror_camera();
  camera.model = CameraModel(kAxes, EquidistantFisheye{237.85, 1.57});
  camera.mask = {};
  camera.height_m = 1.8;
  return camera;
}

void render_along_a_path(benchmark::State& state, const RenderScene& scene, const RenderCamera& camera) {
  const FrameFormat format = packed_format(static_cast<PixelFormat>(state.range(0)), camera.width_px, camera.height_px);
  std::vector<std::byte> frame(format.bytes());
  Renderer renderer(scene, camera);
  Pose2 pose{4.0, 2.5, 0.0};
  for (auto _ : state) {
    renderer.render(pose, {format, frame});
    pose = pose * Pose2{0.03, 0.0, 0.01};
    benchmark::DoNotOptimize(frame.data());
  }
  state.SetLabel(std::string(name(format.pixels)));
}

void render_lab_by_mirror(benchmark::State& state) {
  render_along_a_path(state, coloured_scene(lab(1, 1)), mirror_camera());
}
BENCHMARK(render_lab_by_mirror)
    ->Arg(static_cast<int>(PixelFormat::gray8))
    ->Arg(static_cast<int>(PixelFormat::rgb8))
    ->Arg(static_cast<int>(PixelFormat::yuyv))
    ->Unit(benchmark::kMillisecond);

void render_hall_by_fisheye(benchmark::State& state) {
  render_along_a_path(state, lamp_scene(hall(1, 1), 6.5), fisheye_camera());
}
BENCHMARK(render_hall_by_fisheye)->Arg(static_cast<int>(PixelFormat::gray8))->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace azimuth
