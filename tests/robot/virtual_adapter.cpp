#include "tests/robot/virtual_adapter.hpp"

#include <algorithm>
#include <cerrno>
#include <gtest/gtest.h>

namespace azimuth::test {

using pioneer::Link;
using pioneer::LinkError;
using pioneer::OpenedLink;

class VirtualAdapter::End final : public Link {
 public:
  explicit End(VirtualAdapter& adapter) : adapter_(adapter) {
    EXPECT_EQ(adapter_.open_, nullptr) << "opened twice at a time";
    adapter_.open_ = this;
    adapter_.torn_off_ = false;
    adapter_.forget();
  }
  End(const End&) = delete;
  End& operator=(const End&) = delete;
  ~End() override { adapter_.open_ = nullptr; }

  int descriptor() const override { return -1; }
  bool connecting() const override { return false; }
  std::optional<LinkError> finish_connecting() override { return std::nullopt; }

  Read read(std::span<std::uint8_t> into) override {
    if (!adapter_.works(*this)) return {0, error("read")};
    std::size_t size = 0;
    auto& arriving = adapter_.arriving_;
    for (; size < into.size() && !arriving.empty() && arriving.front().at <= adapter_.now_; ++size) {
      into[size] = arriving.front().byte;
      arriving.pop_front();
    }
    return {size, std::nullopt};
  }

  std::optional<LinkError> write(std::span<const std::uint8_t> bytes) override {
    if (!adapter_.works(*this)) return error("write");
    adapter_.written_.insert(adapter_.written_.end(), bytes.begin(), bytes.end());
    return std::nullopt;
  }
  std::optional<LinkError> flush() override { return std::nullopt; }
  bool has_unsent() const override { return false; }
  bool is_drained() const override { return true; }
  void finish_sending() override {}

  std::optional<LinkError> set_baud(int baud) override {
    if (!adapter_.works(*this)) return error("set the baud rate");
    adapter_.pioneer_.set_client_baud(baud);
    return std::nullopt;
  }
  /// Discards the kernel's input; the adapter's own buffer is unaffected.
  void discard_input() override {
    auto& arriving = adapter_.arriving_;
    while (!arriving.empty() && arriving.front().at <= adapter_.now_) arriving.pop_front();
  }

 private:
  static LinkError error(const char* what) { return {"simulated", what, EIO}; }

  VirtualAdapter& adapter_;
};

VirtualAdapter::VirtualAdapter(sim::SimulatedPioneer& pioneer, const AdapterSettings& settings, std::uint64_t seed)
    : pioneer_(pioneer), settings_(settings), random_(seed, RandomPurpose::line) {
  constexpr std::size_t kLongestWrite = 1024;  // prevents allocations in the driver's write
  written_.reserve(kLongestWrite);
}

pioneer::LinkOpener VirtualAdapter::opener() {
  return [this](const std::string& device) -> OpenedLink {
    if (!pioneer_.plugged_in()) return tl::unexpected(LinkError{device, "open", ENOENT});
    return std::unique_ptr<Link>(new End(*this));
  };
}

void VirtualAdapter::advance(Stamp now) {
  now_ = now;
  if (open_ != nullptr && !pioneer_.plugged_in()) torn_off_ = true;
  whole_.clear();
  pioneer_.take_bytes(whole_);
  if (open_ == nullptr) return;
  for (const std::uint8_t byte : whole_) arriving_.push_back({arrival(now), byte});
}

Stamp VirtualAdapter::arrival(Stamp now) {
  Stamp at = now + settings_.latency;
  if (settings_.timer > Duration{}) {
    const auto ticks = (at.time_since_epoch() + settings_.timer - Duration{1}) / settings_.timer;
    at = Stamp(settings_.timer * ticks);
  }
  // A transfer of the timer arrives as a whole, so only its first byte draws a delay.
  if (!arriving_.empty() && at <= arriving_.back().at) return arriving_.back().at;
  return at + duration_from_seconds(random_.uniform(0.0, to_seconds(settings_.jitter)));
}

void VirtualAdapter::send_written() {
  if (!written_.empty()) pioneer_.client_sends(written_, now_);
  written_.clear();
}

void VirtualAdapter::forget() {
  arriving_.clear();
  written_.clear();
}

Stamp VirtualAdapter::due() const {
  if (open_ == nullptr) return Stamp::max();
  if (torn_off_) return now_;
  return arriving_.empty() ? Stamp::max() : arriving_.front().at;
}

}  // namespace azimuth::test
