// Any line from another program must give a plausible reading or none.

#include <cstdlib>

#include "drivers/fifo/fifo_odometer.hpp"
#include "drivers/wire/plausible.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto reading = azimuth::parse_fifo_line({reinterpret_cast<const char*>(data), size});
  if (reading && !(azimuth::is_plausible(reading->T_odom_body) && azimuth::is_plausible_stamp(to_us(reading->stamp))))
    std::abort();
  return 0;
}
