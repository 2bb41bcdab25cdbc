#include "tools/replay/set_source.hpp"

#include <cassert>
#include <fmt/format.h>
#include <utility>

#include "tools/replay/stop_watch.hpp"

namespace azimuth {

bool RecordedSets::next(BearingSet& out) {
  if (next_ == run_.bearings.size()) return false;
  out = run_.bearings[next_++];
  return true;
}

SeenSets::SeenSets(const Run& run, const ImageRig& rig, ImageFrontEnd front_end)
    : run_(run), rig_(rig), front_end_(std::move(front_end)), images_(run) {
  assert(front_end_.perception);
}

bool SeenSets::next(BearingSet& out) {
  if (next_ == run_.frames.size()) return false;
  const StopWatch watch;
  out.clear();
  if (const ImageView image = next_image(); !image.bytes.empty()) {
    observe(image, out);
  } else {
    out.trouble = ImageTrouble::unreadable;
  }
  out.stamp = run_.frames[next_].stamp;
  out.sequence = next_++;
  last_us_ = watch.elapsed_us();
  return true;
}

/// No bytes: it cannot be used, which is noted.
ImageView SeenSets::next_image() {
  const StopWatch watch;
  ImageView image = images_.pixels(next_, front_end_.decoded);
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
  front_end_.perception->observe(image, out);
  detect_us_.push_back(watch.elapsed_us());
}

/// Directions are worked out for images of one size. Empty: it is of that size, or the rig names none.
std::string SeenSets::size_problem(const FrameFormat& format) const {
  const int width_px = rig_.width_px.value_or(format.width_px), height_px = rig_.height_px.value_or(format.height_px);
  if (format.width_px == width_px && format.height_px == height_px) return {};
  return fmt::format("is {} x {}, but the rig's camera gives {} x {}", format.width_px, format.height_px, width_px,
                     height_px);
}

}  // namespace azimuth
