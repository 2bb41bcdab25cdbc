#include "slam/perception/colour/scan.hpp"

#include "slam/perception/colour/class_table.hpp"
#include "slam/perception/colour/scan_loops.hpp"

namespace azimuth {
namespace {

static_assert(kTableBits == ClassTable::kBits && kTableDropped == ClassTable::kDropped);

bool is_bayer(PixelFormat pixels) {
  return pixels == PixelFormat::bayer_rggb8 || pixels == PixelFormat::bayer_grbg8 ||
         pixels == PixelFormat::bayer_gbrg8 || pixels == PixelFormat::bayer_bggr8;
}

bool has_avx2() {
#if defined(__x86_64__)
  static const bool has = __builtin_cpu_supports("avx2") != 0;
  return has;
#else
  return false;
#endif
}

}  // namespace

bool has_colour(PixelFormat pixels) { return pixels != PixelFormat::gray8 && pixels != PixelFormat::mjpeg; }

int pixels_per_sample(PixelFormat pixels) { return is_bayer(pixels) ? 2 : 1; }

std::size_t find_runs(const Scan& scan, std::span<const VisibleSpan> spans, std::span<ColourRun> out) {
  return has_avx2() ? avx2::find_runs(scan, spans.data(), spans.size(), out.data(), out.size())
                    : scan_image(scan, spans.data(), spans.size(), out.data(), out.size());
}

}  // namespace azimuth
