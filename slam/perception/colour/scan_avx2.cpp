// Compiled with -mavx2 (CMakeLists.txt); called only on processors with AVX2.

#include "slam/perception/colour/scan.hpp"

#define AZIMUTH_BLOCK_BYTES 32
#include "slam/perception/colour/scan_loops.hpp"

namespace azimuth::avx2 {

std::size_t find_runs(const Scan& scan, const VisibleSpan* spans, std::size_t count, ColourRun* out, std::size_t room) {
  return scan_image(scan, spans, count, out, room);
}

}  // namespace azimuth::avx2
