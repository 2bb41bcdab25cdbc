// A program that needs AVX2. It must die on an emulated processor without AVX2; otherwise the emulator could not show
// that our programs avoid such instructions.

#include <immintrin.h>

int main(int argc, char**) {
  const __m256i sum = _mm256_add_epi32(_mm256_set1_epi32(argc), _mm256_set1_epi32(1));
  return _mm256_extract_epi32(sum, 3) == argc + 1 ? 0 : 1;
}
