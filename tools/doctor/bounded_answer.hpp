#pragma once
#include <chrono>
#include <functional>
#include <optional>
#include <string>

namespace azimuth {

/// What `ask` answers, asked in a process of its own: a library that waits for a device for ever is ended with that.
/// Nothing when there is no answer in time. Only for a process without other threads.
std::optional<std::string> answer_within(std::chrono::milliseconds limit, const std::function<std::string()>& ask);

}  // namespace azimuth
