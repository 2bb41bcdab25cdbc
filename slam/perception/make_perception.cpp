#include "slam/perception/make_perception.hpp"

namespace azimuth {

std::unique_ptr<Perception> make_perception(FrontEnd front_end, const CameraRig& /*rig*/,
                                            const PerceptionSettings& /*settings*/) {
  switch (front_end) {
    case FrontEnd::bearings:
    case FrontEnd::colour:
    case FrontEnd::sift:
    case FrontEnd::lamps:
      return nullptr;
  }
  return nullptr;
}

}  // namespace azimuth
