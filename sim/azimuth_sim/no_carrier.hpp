#pragma once
#include <string>
#include <vector>

#include "sim/pioneer/carrier.hpp"

namespace azimuth::sim {

/// Of a robot that has no serial line: nobody comes, and what is sent is gone.
class NoCarrier final : public Carrier {
 public:
  explicit NoCarrier(std::string address) : address_(std::move(address)) {}

  FileResult<void> plug_in() override { return {}; }
  void unplug() override {}
  void watch(std::vector<pollfd>&) const override {}
  std::chrono::milliseconds patience() const override { return std::chrono::milliseconds(1000); }
  void turn(Bytes&) override {}
  void send(pioneer::ByteView) override {}
  bool has_client() const override { return false; }
  std::optional<int> client_baud() const override { return {}; }
  std::string address() const override { return address_; }

 private:
  std::string address_;
};

}  // namespace azimuth::sim
