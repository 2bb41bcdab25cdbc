#pragma once
// The sanitizer of this build: defines AZIMUTH_ADDRESS_SANITIZER, AZIMUTH_THREAD_SANITIZER or neither. GCC and Clang
// announce sanitizers in different ways.

#if defined(__SANITIZE_ADDRESS__)
#define AZIMUTH_ADDRESS_SANITIZER
#elif defined(__SANITIZE_THREAD__)
#define AZIMUTH_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define AZIMUTH_ADDRESS_SANITIZER
#elif __has_feature(thread_sanitizer)
#define AZIMUTH_THREAD_SANITIZER
#endif
#endif
