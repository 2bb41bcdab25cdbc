#pragma once
// Which sanitizer this is compiled for: AZIMUTH_ADDRESS_SANITIZER, AZIMUTH_THREAD_SANITIZER, or neither. GCC and Clang
// say it in ways of their own.

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
