#pragma once
#include <chrono>
#include <functional>
#include <optional>
#include <string>

namespace azimuth {

/// Runs `ask` in a child process and returns its result. If there is no result in time, the child is killed, so that a
/// library that waits for a device for ever does no harm, and the result is nothing. Precondition: the calling process
/// has no other threads.
std::optional<std::string> answer_within(std::chrono::milliseconds limit, const std::function<std::string()>& ask);

}  // namespace azimuth
