#include "tools/replay/set_source.hpp"

#include <fmt/format.h>
#include <utility>

#include "slam/camera/make_camera.hpp"

namespace azimuth {

bool RecordedSets::next(BearingSet& out) {
  if (next_ == run_.bearings.size()) return false;
  out = run_.bearings[next_++];
  return true;
}

SeenSets::SeenSets(const Run& run, const ImageRig& rig, ImageFrontEnd front_end)
    : run_(run), rig_(rig), decoded_(front_end.decoded), stage_(std::move(front_end.perception)), images_(run) {}

bool SeenSets::next(BearingSet& out) {
  if (next_ == run_.frames.size()) return false;
  const StopWatch watch;
  observe(next_image(), out);
  ++next_;
  last_us_ = watch.elapsed_us();
  return true;
}

/// The next image; no bytes if it is unusable, in which case the reason is recorded.
ImageView SeenSets::next_image() {
  const StopWatch watch;
  ImageView image = images_.pixels(next_, decoded_);
  decode_us_.push_back(watch.elapsed_us());
  std::string problem = images_.problem();
  if (problem.empty()) {
    problem = size_problem(image.format);
    if (!problem.empty()) problem = run_.frames[next_].file + ": " + problem;
  }
  if (!problem.empty()) image = {};
  if (first_unreadable_.empty()) first_unreadable_ = std::move(problem);
  return image;
}

void SeenSets::observe(const ImageView& image, BearingSet& out) {
  const StopWatch watch;
  stage_.observe(image, run_.frames[next_].stamp, next_, out);
  if (!image.bytes.empty()) detect_us_.push_back(watch.elapsed_us());
}

/// Error text if the image does not have the rig's size, for which the camera model is valid. Empty if the size is
/// right or if the rig states none.
std::string SeenSets::size_problem(const FrameFormat& format) const {
  if (is_size_of(format, rig_)) return {};
  return fmt::format("is {} x {}, but the rig's camera gives {} x {}", format.width_px, format.height_px,
                     rig_.width_px.value_or(format.width_px), rig_.height_px.value_or(format.height_px));
}

}  // namespace azimuth
