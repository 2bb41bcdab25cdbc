#pragma once
// Internal to drivers/pioneer: the termios calls of Linux for a serial line. All functions with a result return 0 or
// errno.

namespace azimuth::pioneer {

/// Raw 8N1 without flow control, receiver on, modem lines ignored; the rate is not changed.
int make_raw(int fd);
/// Prevents other processes from opening the line. Pseudo-terminals, which are used in tests, stay open to all.
int claim_exclusively(int fd);
/// Asks the adapter to pass bytes on without delay. A line that does not support this is not an error.
void ask_for_low_latency(int fd);
/// Sets the baud rate. EINVAL: termios does not have the rate.
int set_line_baud(int fd, int baud);

}  // namespace azimuth::pioneer
