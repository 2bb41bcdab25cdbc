// What a program of ours would be if it used a loop that the processor has not: it must die where that is so, else the
// emulator is no judge.

#include <immintrin.h>

int main(int argc, char**) {
  const __m256i sum = _mm256_add_epi32(_mm256_set1_epi32(argc), _mm256_set1_epi32(1));
  return _mm256_extract_epi32(sum, 3) == argc + 1 ? 0 : 1;
}
