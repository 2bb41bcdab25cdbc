#include "drivers/lcm/lcm_address.hpp"

#include <gtest/gtest.h>

namespace azimuth {
namespace {

std::string parsed(std::string_view url) {
  const auto address = parse_lcm_url(url);
  return address ? text(*address) : "none";
}

TEST(LcmAddress, IsReadFromAUrl) {
  EXPECT_EQ(parsed("udpm://239.255.76.67:7667?ttl=0"), "udpm://239.255.76.67:7667");
  EXPECT_EQ(parsed("udpm://224.0.0.1:1"), "udpm://224.0.0.1:1");
  EXPECT_EQ(parsed("udpm://239.1.2.3"), "udpm://239.1.2.3:7667");
  EXPECT_EQ(parsed("udpm://"), "udpm://239.255.76.67:7667");
  EXPECT_EQ(parsed("udpm://?ttl=1"), "udpm://239.255.76.67:7667");
}

TEST(LcmAddress, RefusesOtherProvidersAndWhatIsNoGroup) {
  for (const char* url : {"", "tcpq://127.0.0.1:7700", "memq://", "file:///tmp/log", "udpm://127.0.0.1:7667",
                          "udpm://240.0.0.1:7667", "udpm://robot:7667", "udpm://239.1.2.3:", "udpm://239.1.2.3:0",
                          "udpm://239.1.2.3:65536", "udpm://239.1.2.3:7x", "udpm://239.1.2:7667"})
    EXPECT_EQ(parsed(url), "none") << url;
}

}  // namespace
}  // namespace azimuth
