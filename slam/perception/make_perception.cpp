#include "slam/perception/make_perception.hpp"

#include "slam/perception/colour/colour_perception.hpp"
#include "slam/perception/sift/sift_perception.hpp"

namespace azimuth {

std::unique_ptr<Perception> make_perception(FrontEnd front_end, const CameraRig& rig,
                                            const PerceptionSettings& settings) {
  switch (front_end) {
    case FrontEnd::colour:
      return std::make_unique<ColourPerception>(rig, settings.colour);
    case FrontEnd::sift:
      return std::make_unique<SiftPerception>(rig, settings.sift);
    case FrontEnd::bearings:
    case FrontEnd::lamps:
      return nullptr;
  }
  return nullptr;
}

PixelFormat decoded_format(FrontEnd front_end) {
  return front_end == FrontEnd::colour ? PixelFormat::rgb8 : PixelFormat::gray8;
}

}  // namespace azimuth
