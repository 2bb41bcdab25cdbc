#include "tests/support/allocation_counter.hpp"

#include <cstdlib>

#include "base/sanitizers.hpp"

namespace {
thread_local std::size_t counted = 0;
}  // namespace

std::size_t azimuth::allocations() { return counted; }

#if defined(AZIMUTH_ADDRESS_SANITIZER) || defined(AZIMUTH_THREAD_SANITIZER)

// The sanitizers replace malloc and offer a hook. Not every compiler installs the header that declares the hook.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*, std::size_t),
                                                         void (*on_free)(const volatile void*));

namespace {
void on_malloc(const volatile void*, std::size_t) { ++counted; }
void on_free(const volatile void*) {}
[[maybe_unused]] const int installed = __sanitizer_install_malloc_and_free_hooks(on_malloc, on_free);
}  // namespace

#else

// Definitions in the program take precedence over those of the C library, which also exports its own as __libc_*.
extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT(bugprone-reserved-identifier)
void* __libc_calloc(std::size_t number, std::size_t size);       // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void* old, std::size_t size);               // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT(bugprone-reserved-identifier)

void* malloc(std::size_t size) {
  ++counted;
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  ++counted;
  return __libc_calloc(number, size);
}
void* realloc(void* old, std::size_t size) {
  ++counted;
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++counted;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  ++counted;
  *out = __libc_memalign(alignment, size);
  return *out != nullptr || size == 0 ? 0 : 12;  // ENOMEM
}
}

#endif
