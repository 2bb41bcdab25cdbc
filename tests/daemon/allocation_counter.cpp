#include "tests/daemon/allocation_counter.hpp"

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <string_view>
#include <sys/prctl.h>

#include "base/sanitizers.hpp"

namespace azimuth::test {
namespace {

std::atomic<bool> armed{false};
std::atomic<std::uint64_t> allocations{0};

/// Whether the calling thread is counted. The system call that reads its name does not allocate.
bool is_watched_thread() {
  char name[16] = {};
  prctl(PR_GET_NAME, name);
  const std::string_view thread(name);
  return thread == "player" || thread == "perception" || thread == "estimator";
}

[[maybe_unused]] void note() {
  if (armed.load(std::memory_order_relaxed) && is_watched_thread()) allocations.fetch_add(1);
}

}  // namespace

void arm_allocation_counter() { armed = true; }
void disarm_allocation_counter() { armed = false; }
std::uint64_t counted_allocations() { return allocations; }
void reset_allocation_counter() { allocations = 0; }

#if defined(AZIMUTH_ADDRESS_SANITIZER) || defined(AZIMUTH_THREAD_SANITIZER)

bool can_count_allocations() { return false; }

#else

bool can_count_allocations() { return true; }

extern "C" {

// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
// glibc's own functions, under the names that it provides for programs that replace the public ones.
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

void* malloc(std::size_t size) {
  note();
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  note();
  return __libc_calloc(count, size);
}

void* realloc(void* old, std::size_t size) {
  note();
  return __libc_realloc(old, size);
}

void* memalign(std::size_t alignment, std::size_t size) {
  note();
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }

int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  *out = memalign(alignment, size);
  return *out ? 0 : ENOMEM;
}

}  // extern "C"

#endif

}  // namespace azimuth::test
