#include "daemon/publish/lcm_sender.hpp"

#include <algorithm>
#include <cerrno>
#include <lcm/lcm.h>
#include <spdlog/spdlog.h>
#include <system_error>
#include <utility>

namespace azimuth {
namespace {

constexpr std::chrono::seconds kFirstPause{1}, kLongestPause{30};

}  // namespace

LcmSender::LcmSender(std::string url, std::string prefix)
    : url_(std::move(url)), prefix_(std::move(prefix)), pause_(kFirstPause) {}

LcmSender::~LcmSender() {
  if (lcm_) lcm_destroy(lcm_);
}

LcmSender::LcmSender(LcmSender&& other) noexcept
    : url_(std::move(other.url_)),
      prefix_(std::move(other.prefix_)),
      lcm_(std::exchange(other.lcm_, nullptr)),
      pause_(kFirstPause) {}

void LcmSender::send_bytes(std::string_view channel) {
  if (!connect()) {
    ++failures_;
    return;
  }
  channel_.assign(prefix_).append(channel);
  errno = 0;
  const bool sent = lcm_publish(lcm_, channel_.c_str(), buffer_.data(), static_cast<unsigned>(buffer_.size())) == 0;
  if (!sent) ++failures_;
  note(sent, "publish", errno);
}

bool LcmSender::connect() {
  if (lcm_) return true;
  const auto now = std::chrono::steady_clock::now();
  if (now < next_try_) return false;
  next_try_ = now + pause_;
  pause_ = std::min(2 * pause_, kLongestPause);
  errno = 0;
  lcm_ = lcm_create(url_.c_str());
  if (!lcm_) note(false, "open", errno);
  return lcm_ != nullptr;
}

void LcmSender::note(bool works, const char* what, int error) {
  if (works != failing_) return;
  failing_ = !works;
  if (works) {
    spdlog::info("LCM {}: publishing again after {} failures", url_, failures_);
  } else {
    spdlog::warn("LCM {}: cannot {}: {}; counted from here on", url_, what,
                 error ? std::generic_category().message(error) : "unknown");
  }
}

}  // namespace azimuth
