#pragma once
// Internal to drivers/pioneer: the order in which baud rates are tried.

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace azimuth::pioneer {

/// All baud rates of a controller, the most frequent start rates first.
inline constexpr std::array kControllerBauds{9600, 38400, 115200, 19200, 57600};

/// A short list of rates without repetitions. It has one entry of 0 for a link without a baud rate.
class BaudSearch {
 public:
  void restart() { count_ = at_ = 0; }
  /// Ignores 0 and rates already in the list.
  void add(int baud) {
    const auto all = std::span(bauds_).first(count_);
    if (baud != 0 && count_ < bauds_.size() && std::ranges::find(all, baud) == all.end()) bauds_[count_++] = baud;
  }
  int current() const { return count_ > 0 ? bauds_[at_] : 0; }
  /// Goes to the next rate. False: the end was reached, and the list starts again.
  bool advance() {
    if (++at_ < count_) return true;
    at_ = 0;
    return false;
  }

 private:
  std::array<int, kControllerBauds.size() + 3> bauds_{};
  std::size_t count_ = 0, at_ = 0;
};

}  // namespace azimuth::pioneer
