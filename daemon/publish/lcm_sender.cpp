#include "daemon/publish/lcm_sender.hpp"

#include <algorithm>
#include <cerrno>
#include <lcm/lcm.h>
#include <spdlog/spdlog.h>
#include <system_error>
#include <utility>

#include "drivers/lcm/lcm_address.hpp"

namespace azimuth {
namespace {

constexpr std::chrono::seconds kFirstPause{1}, kLongestPause{30};

}  // namespace

LcmSender::LcmSender(std::string url, std::string prefix)
    : url_(std::move(url)), prefix_(std::move(prefix)), back_off_(kFirstPause, kLongestPause) {}

LcmSender::~LcmSender() {
  if (lcm_) lcm_destroy(lcm_);
}

LcmSender::LcmSender(LcmSender&& other) noexcept
    : url_(std::move(other.url_)),
      prefix_(std::move(other.prefix_)),
      lcm_(std::exchange(other.lcm_, nullptr)),
      back_off_(other.back_off_) {}

void LcmSender::send_bytes(std::string_view channel) {
  if (!connect()) {
    ++failures_;
    return;
  }
  channel_.assign(prefix_).append(channel);
  errno = 0;
  const bool sent = lcm_publish(lcm_, channel_.c_str(), buffer_.data(), static_cast<unsigned>(buffer_.size())) == 0;
  if (!sent) ++failures_;
  if (sent) return note_working();
  note_trouble("cannot publish", errno);
}

bool LcmSender::connect() {
  if (lcm_) return true;
  const auto now = std::chrono::steady_clock::now();
  if (!back_off_.is_due(now)) return false;
  back_off_.failed(now);  // assumes a failure; a success ends the retries
  // liblcm prints a long message about a missing network at each try, so it is not called then.
  const auto address = parse_lcm_url(url_);
  const int error = address ? route_error(*address) : 0;
  if (error != 0) {
    note_trouble("nobody will hear poses and map, since there is no network for them (see azimuth doctor)", error);
    return false;
  }
  errno = 0;
  lcm_ = lcm_create(url_.c_str());
  if (!lcm_) note_trouble("cannot open", errno);
  return lcm_ != nullptr;
}

void LcmSender::note_working() {
  if (!std::exchange(failing_, false)) return;
  spdlog::info("LCM {}: publishing again after {} failures", url_, failures_);
}

void LcmSender::note_trouble(const char* what, int error) {
  if (std::exchange(failing_, true)) return;
  spdlog::warn("LCM {}: {}: {}; counted from here on", url_, what,
               error ? std::generic_category().message(error) : "unknown");
}

}  // namespace azimuth
