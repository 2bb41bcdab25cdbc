#pragma once
#include <functional>

namespace azimuth {

/// Does one thing at a time beside the thread that asks. Threads are made elsewhere: here there are none.
class Errand {
 public:
  virtual ~Errand() = default;
  /// Begins `work`. Nothing may be under way.
  virtual void begin(std::function<void()> work) = 0;
  /// Returns when what was begun is done; at once when nothing was.
  virtual void finish() = 0;
};

/// On the thread that asks, before begin() returns.
class AtOnce final : public Errand {
 public:
  void begin(std::function<void()> work) override { work(); }
  void finish() override {}
};

}  // namespace azimuth
