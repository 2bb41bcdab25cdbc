// Any script of what a Pioneer and its line may do: session and odometer keep their promises, send only what moves
// nothing, and afterwards a robot in good order gets its session.

#include "tests/drivers/pioneer/conversation.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kLongest = 2000;  // each byte may take a third of a second of virtual time
  azimuth::pioneer::test::Conversation conversation({});
  conversation.play({data, std::min(size, kLongest)});
  azimuth::pioneer::test::require(conversation.recovers());
  return 0;
}
