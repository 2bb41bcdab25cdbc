#!/usr/bin/env python3
"""Lists the number of messages, the bytes and the rate of each channel of an LCM event log.

usage: log_channels.py FILE      exit code 1 if it has no message
"""

import struct
import sys
from collections import defaultdict

SYNC = 0xEDA1DA01
HEADER = struct.Struct(">IqqII")  # sync, event number, utime, lengths of channel and data


def events(log):
    """Yields (utime, channel, number of bytes) of each event, up to the first incomplete or damaged one."""
    at = 0
    while at + HEADER.size <= len(log):
        sync, _, utime, channel_bytes, data_bytes = HEADER.unpack_from(log, at)
        end = at + HEADER.size + channel_bytes + data_bytes
        if sync != SYNC or end > len(log):
            return
        channel = log[at + HEADER.size:at + HEADER.size + channel_bytes]
        yield utime, channel.decode("ascii", "replace"), data_bytes
        at = end


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: log_channels.py FILE")
    with open(sys.argv[1], "rb") as file:
        log = file.read()
    messages, volume, first, last = defaultdict(int), defaultdict(int), {}, {}
    for utime, channel, data_bytes in events(log):
        messages[channel] += 1
        volume[channel] += data_bytes
        first.setdefault(channel, utime)
        last[channel] = utime
    if not messages:
        sys.exit(f"{sys.argv[1]}: no message")
    print(f"{'channel':<22}{'messages':>10}{'bytes':>12}{'per second':>12}")
    for channel in sorted(messages):
        seconds = (last[channel] - first[channel]) * 1e-6
        rate = f"{(messages[channel] - 1) / seconds:.1f}" if seconds > 0 else "-"
        print(f"{channel:<22}{messages[channel]:>10}{volume[channel]:>12}{rate:>12}")


if __name__ == "__main__":
    main()
