#include "tools/azimuth/progress_bar.hpp"

#include <array>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <string>
#include <thread>
#include <unistd.h>

#include "base/unique_fd.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

/// Replaces standard error by a terminal or a pipe during the life of the object.
class StandardError {
 public:
  explicit StandardError(bool terminal) : before_(::dup(STDERR_FILENO)) {
    int ours = -1, theirs = -1;
    std::array<int, 2> ends{};
    if (terminal && ::openpty(&ours, &theirs, nullptr, nullptr, nullptr) == 0) ends = {ours, theirs};
    if (!terminal && ::pipe(ends.data()) != 0) ends = {-1, -1};
    reading_ = UniqueFd(ends[0]);
    ::dup2(ends[1], STDERR_FILENO);
    ::close(ends[1]);
    ::fcntl(reading_.get(), F_SETFL, O_NONBLOCK);
  }
  ~StandardError() { ::dup2(before_.get(), STDERR_FILENO); }
  StandardError(const StandardError&) = delete;
  StandardError& operator=(const StandardError&) = delete;

  std::string written() {
    std::string text;
    std::array<char, 4096> part{};
    for (;;) {
      const ssize_t got = ::read(reading_.get(), part.data(), part.size());
      if (got <= 0) return text;
      text.append(part.data(), static_cast<std::size_t>(got));
    }
  }

 private:
  UniqueFd before_, reading_;
};

TEST(ProgressText, SaysHowLongTheRestTakesAtThisPace) {
  EXPECT_EQ(progress_text("images", 30, 120, 10.0),
            "[#######.......................]  25 %  30 of 120 images, 30 s left");
  EXPECT_EQ(progress_text("logs", 1, 1000, 1.0), "[..............................]   0 %  1 of 1000 logs, 17 min left");
  EXPECT_EQ(progress_text("logs", 1, 30000, 1.0),
            "[..............................]   0 %  1 of 30000 logs, 8.3 h left");
  EXPECT_EQ(progress_text("", 0, 3, 4.0), "[..............................]   0 %  0 of 3");
}

TEST(ProgressText, AtTheEndSomethingMayStillBeDone) {
  EXPECT_EQ(progress_text("maps", 4, 4, 4.0), "[##############################] 100 %  4 of 4 maps, finishing");
  EXPECT_EQ(progress_text("maps", 5, 4, 4.0), progress_text("maps", 4, 4, 4.0)) << "more than was told of before";
}

TEST(ProgressBar, IsForATerminalAndWorkThatTakesLong) {
  StandardError terminal(true);
  {
    ProgressBar bar(true, "images");
    bar.update(1, 10);
    EXPECT_EQ(terminal.written(), "") << "it may be done soon";
    std::this_thread::sleep_for(550ms);
    bar.listener()(5, 10);
    EXPECT_NE(terminal.written().find("5 of 10 images, "), std::string::npos);
    bar.update(10, 10);
    EXPECT_NE(terminal.written().find("finishing"), std::string::npos) << "however soon after";
  }
  EXPECT_EQ(terminal.written(), "\r\x1b[2K") << "nothing stays";
}

TEST(ProgressBar, WritesNothingWhereNobodyWatchesOrWantsIt) {
  StandardError pipe(false);
  ProgressBar piped(true, "images");
  std::this_thread::sleep_for(550ms);
  piped.update(5, 10);
  EXPECT_EQ(pipe.written(), "");
  StandardError terminal(true);
  ProgressBar quiet(false, "images");
  std::this_thread::sleep_for(550ms);
  quiet.update(5, 10);
  EXPECT_EQ(terminal.written(), "");
}

}  // namespace
}  // namespace azimuth
