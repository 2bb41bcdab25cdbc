#include "tools/import/raw_images.hpp"

#include <algorithm>
#include <system_error>

#include "drivers/camera/run_images.hpp"
#include "tools/import/bag_run.hpp"
#include "tools/import/foreign_images.hpp"

namespace azimuth {
namespace {

bool is_raw(const FrameFile& frame) { return frame.part && frame.part->format.pixels != PixelFormat::mjpeg; }

}  // namespace

FileResult<void> bring_raw_images(Run& run, const std::filesystem::path& out) {
  if (std::ranges::none_of(run.frames, is_raw)) return {};
  if (auto made = make_frames_folder(out); !made) return made;
  FolderImages files(out);
  RunImages images(run);
  std::vector<FrameFile> frames = run.frames;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!is_raw(frames[i])) continue;
    const ImageView image = images.recorded(i);
    frames[i] = {frames[i].stamp, numbered_image(i, "png")};
    std::error_code ignored;  // removes a file of an earlier import
    std::filesystem::remove(out / frames[i].file, ignored);
    if (image.bytes.empty()) continue;
    if (auto kept = files.keep(i, frames[i].stamp, image); !kept) return failure(kept.error());
  }
  run.frames = std::move(frames);
  return {};
}

}  // namespace azimuth
