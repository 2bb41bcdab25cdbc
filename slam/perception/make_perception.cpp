#include "slam/perception/make_perception.hpp"

#include <utility>

#include "slam/perception/colour/colour_perception.hpp"
#include "slam/perception/lamps/lamp_perception.hpp"
#include "slam/perception/sift/sift_perception.hpp"

namespace azimuth {

namespace {

std::unique_ptr<Perception> bare_perception(FrontEnd front_end, const CameraRig& rig,
                                            const PerceptionSettings& settings) {
  switch (front_end) {
    case FrontEnd::colour:
      return std::make_unique<ColourPerception>(rig, settings.colour);
    case FrontEnd::sift:
      return std::make_unique<SiftPerception>(rig, settings.sift);
    case FrontEnd::lamps:
      return std::make_unique<LampPerception>(rig, settings.lamps);
    case FrontEnd::bearings:
      return nullptr;
  }
  return nullptr;
}

}  // namespace

std::unique_ptr<Perception> make_perception(FrontEnd front_end, const CameraRig& rig,
                                            const PerceptionSettings& settings) {
  std::unique_ptr<Perception> perception = bare_perception(front_end, rig, settings);
  if (!perception) return nullptr;
  return std::make_unique<WatchedPerception>(std::move(perception), ImageWatch(rig.image));
}

PixelFormat decoded_format(FrontEnd front_end) {
  return front_end == FrontEnd::colour ? PixelFormat::rgb8 : PixelFormat::gray8;
}

}  // namespace azimuth
