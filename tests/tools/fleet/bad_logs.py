"""Makes bad field logs: cut off, damaged, of older versions, without a rig, empty, or no logs at all."""

import random
import struct

EVENT = struct.Struct(">IQQII")     # of LCM: sync word, number, microseconds, lengths of channel and data
SYNC = 0xEDA1DA01


def events(log):
    """Yields (number, microseconds, channel, data) of each event."""
    at = 0
    while at < len(log):
        sync, number, utime_us, channel_bytes, data_bytes = EVENT.unpack_from(log, at)
        assert sync == SYNC, at
        at += EVENT.size
        yield number, utime_us, log[at:at + channel_bytes], log[at + channel_bytes:at + channel_bytes + data_bytes]
        at += channel_bytes + data_bytes


def log_of(all_events):
    return b"".join(EVENT.pack(SYNC, number, utime_us, len(channel), len(data)) + channel + data for number, utime_us, channel, data in all_events)


def without_rig(log):
    return log_of(event for event in events(log) if not (event[2] == b"AZIMUTH_DOCUMENT" and b"rig.toml" in event[3]))


def older(log, channel, every):
    """Gives every `every`-th message of a channel another type fingerprint (its first eight bytes), as an older version
    would write it."""
    seen = 0
    changed = []
    for number, utime_us, name, data in events(log):
        if name == channel:
            seen += 1
            data = bytes(8) + data[8:] if seen % every == 0 else data
        changed.append((number, utime_us, name, data))
    return log_of(changed)


def bad_logs(log):
    """Makes all bad logs from a good one: {name: bytes}."""
    noise = random.Random(1).randbytes(5000)
    middle = len(log) // 2
    return {"cut": log[:middle + 7], "damaged": log[:middle] + noise + log[middle + 3000:], "partly_older": older(log, b"AZIMUTH_BEARINGS", 10),
            "all_older": older(log, b"AZIMUTH_ODOM", 1), "no_rig": without_rig(log), "empty": b"", "noise": noise}
