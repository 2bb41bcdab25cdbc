"""Field logs as they come home from robots: cut, damaged, of older versions, without a rig, empty or no logs at all."""

import random
import struct

EVENT = struct.Struct(">IQQII")     # LCM's: sync word, number, microseconds, lengths of channel and data
SYNC = 0xEDA1DA01


def events(log):
    """(number, microseconds, channel, data) of each."""
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
    """Each so many messages of a channel as a version wrote them whose message had other fields: its first eight bytes say so."""
    seen = 0
    changed = []
    for number, utime_us, name, data in events(log):
        if name == channel:
            seen += 1
            data = bytes(8) + data[8:] if seen % every == 0 else data
        changed.append((number, utime_us, name, data))
    return log_of(changed)


def bad_logs(log):
    """{name: bytes}, of a good one."""
    noise = random.Random(1).randbytes(5000)
    middle = len(log) // 2
    return {"cut": log[:middle + 7], "damaged": log[:middle] + noise + log[middle + 3000:], "partly_older": older(log, b"AZIMUTH_BEARINGS", 10),
            "all_older": older(log, b"AZIMUTH_ODOM", 1), "no_rig": without_rig(log), "empty": b"", "noise": noise}
