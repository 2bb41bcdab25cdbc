// Any script of events at a Pioneer and its line. Session and odometer must keep their invariants and send no command
// that moves the robot; afterwards a robot that works correctly must get its session.

#include "tests/drivers/pioneer/conversation.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kLongest = 2000;  // each byte may take a third of a second of virtual time
  azimuth::pioneer::test::Conversation conversation({});
  conversation.play({data, std::min(size, kLongest)});
  azimuth::pioneer::test::require(conversation.recovers());
  return 0;
}
