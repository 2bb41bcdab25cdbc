#pragma once
#include <string>
#include <vector>

namespace azimuth {

/// The IIDC cameras that libdc1394 finds on FireWire and USB, as far as this process may open their nodes.
struct IidcBus {
  std::vector<std::string> guids{};  ///< ascending, each with 16 digits
  std::string trouble{};             ///< why the search failed, or the library's message; empty: none
};

/// Opens no camera, but asks each device on the buses for its identity. This blocks for as long as libdc1394 waits for
/// an answer.
///
/// Thread contract: thread-bound, as libdc1394 is.
IidcBus list_iidc_cameras();

}  // namespace azimuth
