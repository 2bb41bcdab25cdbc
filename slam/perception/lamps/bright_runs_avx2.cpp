// Compiled with -mavx2 (CMakeLists.txt); called only on processors with AVX2.

#include "slam/perception/lamps/bright_runs_loops.hpp"

namespace azimuth::avx2 {

std::size_t bright_runs(const std::uint8_t* pixels, const PixelRun& where, int level, PixelRun* out, std::size_t room) {
  return find_bright_runs(pixels, where, level, out, room);
}

}  // namespace azimuth::avx2
