#pragma once
// Internal to drivers/pioneer: what termios calls of Linux a serial line needs. All return 0 or the errno.

namespace azimuth::pioneer {

/// Raw 8N1 without flow control, receiver on, modem lines ignored; the rate as it is.
int make_raw(int fd);
/// No other process may open the line; pseudo terminals, which are for tests, stay open to all.
int claim_exclusively(int fd);
/// Asks the adapter not to collect bytes before it passes them on. Not every line has that; no error then.
void ask_for_low_latency(int fd);
/// EINVAL for a rate that termios does not have.
int set_line_baud(int fd, int baud);

}  // namespace azimuth::pioneer
