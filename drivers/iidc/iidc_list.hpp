#pragma once
#include <string>
#include <vector>

namespace azimuth {

/// IIDC cameras that libdc1394 finds, on FireWire and USB, as far as this process may open their nodes.
struct IidcBus {
  std::vector<std::string> guids{};  ///< ascending, each with its 16 digits
  std::string trouble{};             ///< why it cannot look, or what it complained about; empty: nothing
};

/// Opens no camera, but asks each device on the buses who it is, which blocks as long as libdc1394 waits for an answer.
///
/// Thread contract: thread-bound, as libdc1394 is.
IidcBus list_iidc_cameras();

}  // namespace azimuth
