#include "tests/daemon/lcm_logger.hpp"

#include <azimuth/odometry_t.hpp>
#include <chrono>
#include <csignal>
#include <gtest/gtest.h>
#include <thread>

#include "daemon/publish/lcm_sender.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;

constexpr auto kLoggerPatience = 60s;
constexpr char kUrl[] = "udpm://239.255.76.67:7667?ttl=0";

}  // namespace

LcmLogger::LcmLogger(std::filesystem::path log, const std::filesystem::path& folder)
    : log_(std::move(log)),
      process_({"lcm-logger", "-f", "--flush-interval=10", std::string("--lcm-url=") + kUrl + "&recv_buf_size=2097152",
                log_},
               folder) {}

bool LcmLogger::hears() {
  LcmSender sender(kUrl, "");
  const bool heard = eventually(
      [&] {
        sender.send(kProbe, odometry_t{});
        std::this_thread::sleep_for(10ms);
        std::error_code missing;
        const std::uintmax_t size = std::filesystem::file_size(log_, missing);
        return !missing && size > 0;
      },
      kLoggerPatience);
  if (!heard) ADD_FAILURE() << "lcm-logger hears nothing: " << process_.standard_error();
  return heard;
}

/// lcm-logger writes from a queue on a thread of its own, so this waits until the file stops growing.
void LcmLogger::finish() {
  std::uintmax_t size = 0;
  do {
    size = std::filesystem::file_size(log_);
    std::this_thread::sleep_for(400ms);
  } while (std::filesystem::file_size(log_) != size);
  process_.signal(SIGINT);
  EXPECT_EQ(process_.wait(kLoggerPatience), 0);
}

}  // namespace azimuth::test
