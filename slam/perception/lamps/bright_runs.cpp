#include "slam/perception/lamps/bright_runs.hpp"

#include "slam/perception/lamps/bright_runs_loops.hpp"

namespace azimuth {

std::size_t bright_runs(const std::uint8_t* pixels, const PixelRun& where, int level, PixelRun* out, std::size_t room) {
#if defined(__x86_64__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  if (has_avx2) return avx2::bright_runs(pixels, where, level, out, room);
#endif
  return portable::bright_runs(pixels, where, level, out, room);
}

namespace portable {

std::size_t bright_runs(const std::uint8_t* pixels, const PixelRun& where, int level, PixelRun* out, std::size_t room) {
  return find_bright_runs(pixels, where, level, out, room);
}

}  // namespace portable

}  // namespace azimuth
