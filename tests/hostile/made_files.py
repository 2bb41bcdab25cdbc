"""Makes recordings, images and compressed data byte by byte, because no library writes the faults that the tests
need."""

import bz2
import struct
import zlib


def u16(value):
    return struct.pack("<H", value)


def u32(value):
    return struct.pack("<I", value)


def u64(value):
    return struct.pack("<Q", value)


# Bags of ROS 1 and MCAP.

HEADER = "uint32 seq\ntime stamp\nstring frame_id\n"
SEPARATOR = "=" * 80 + "\n"
ODOMETRY = (
    "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
    + SEPARATOR + "MSG: std_msgs/Header\n" + HEADER
    + SEPARATOR + "MSG: geometry_msgs/PoseWithCovariance\ngeometry_msgs/Pose pose\nfloat64[36] covariance\n"
    + SEPARATOR + "MSG: geometry_msgs/Pose\ngeometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"
    + SEPARATOR + "MSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n"
    + SEPARATOR + "MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n")
IMAGE = (
    "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\nuint8[] data\n"
    + SEPARATOR + "MSG: std_msgs/Header\n" + HEADER)
COMPRESSED = "std_msgs/Header header\nstring format\nuint8[] data\n" + SEPARATOR + "MSG: std_msgs/Header\n" + HEADER
BAG_BEGIN = b"#ROSBAG V2.0\n"
MCAP_BEGIN = b"\x89MCAP0\r\n"


def field(name, value):
    content = name.encode() + b"=" + value
    return u32(len(content)) + content


def record(op, fields, data):
    header = field("op", bytes([op])) + b"".join(field(name, value) for name, value in fields)
    return u32(len(header)) + header + u32(len(data)) + data


def connection(number, topic, kind, definition):
    said = [("topic", topic), ("type", kind.encode()), ("md5sum", b"1"), ("message_definition", definition.encode())]
    data = b"".join(field(name, value) for name, value in said)
    return record(7, [("conn", u32(number)), ("topic", topic)], data)


def message(number, second, data):
    return record(2, [("conn", u32(number)), ("time", u32(second) + u32(0))], data)


def chunk(compression, packed, unpacked=1):
    return record(5, [("compression", compression.encode()), ("size", u32(unpacked))], packed)


def ros_header(second):
    return u32(0) + u32(second) + u32(0) + u32(1) + b"o"


def odometry(second, x_m):
    pose = struct.pack("<7d", x_m, 0, 0, 0, 0, 0, 1)
    return ros_header(second) + u32(1) + b"b" + pose + bytes(36 * 8)


def ros_image(second, width, height, encoding, step, data):
    said = encoding.encode()
    return (ros_header(second) + u32(height) + u32(width) + u32(len(said)) + said + b"\0" + u32(step)
            + u32(len(data)) + data)


def ros_compressed(second, data):
    return ros_header(second) + u32(4) + b"jpeg" + u32(len(data)) + data


def mcap_record(op, content):
    return bytes([op]) + u64(len(content)) + content


def mcap_text(text):
    content = text.encode() if isinstance(text, str) else text
    return u32(len(content)) + content


def mcap_schema(number, name, encoding, definition):
    return mcap_record(3, u16(number) + mcap_text(name) + mcap_text(encoding) + mcap_text(definition))


def mcap_channel(number, schema, topic, encoding="ros1"):
    return mcap_record(4, u16(number) + u16(schema) + mcap_text(topic) + mcap_text(encoding) + u32(0))


def mcap_message(channel, second, data):
    return mcap_record(5, u16(channel) + u32(0) + u64(second * 10**9) * 2 + data)


def mcap_chunk(compression, packed, unpacked):
    return mcap_record(6, u64(0) * 2 + u64(unpacked) + u32(0) + mcap_text(compression) + u64(len(packed)) + packed)


def drive_bag(compression="none", readings=50):
    body = connection(0, b"/odom", "nav_msgs/Odometry", ODOMETRY)
    body += b"".join(message(0, 10 + i, odometry(10 + i, 0.1 * i)) for i in range(readings))
    packed = bz2.compress(body) if compression == "bz2" else body
    return BAG_BEGIN + chunk(compression, packed, len(body))


def drive_mcap(readings=50):
    body = mcap_schema(1, "nav_msgs/Odometry", "ros1msg", ODOMETRY) + mcap_channel(1, 1, "/odom")
    body += b"".join(mcap_message(1, 10 + i, odometry(10 + i, 0.1 * i)) for i in range(readings))
    return MCAP_BEGIN + mcap_chunk("", body, len(body)) + MCAP_BEGIN


# Compressed data of one repeated byte.


def zstd_of(byte, blocks):
    """A frame of blocks, each of which repeats one byte 128 k times."""
    frame = b"\x28\xb5\x2f\xfd" + bytes([0, 7 << 3])  # without content size, window of 128 kB
    size = 1 << 17
    for i in range(blocks):
        frame += struct.pack("<I", (i == blocks - 1) | 1 << 1 | size << 3)[:3] + bytes([byte])
    return frame


def lz4_of(byte, megabytes):
    """A frame of blocks of 4 MB, each a literal byte and a match at offset 1. The header checksum (0x73) belongs to
    these flags."""
    frame = b"\x04\x22\x4d\x18" + b"\x60\x70" + b"\x73"
    size = 4 << 20
    run = size - 1 - 5 - 4 - 15
    block = bytes([0x1f, byte]) + u16(1) + b"\xff" * (run // 255) + bytes([run % 255]) + bytes([0x50]) + bytes([byte]) * 5
    for _ in range(megabytes // 4):
        frame += u32(len(block)) + block
    return frame + u32(0)


# Images.


def png_chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(width, height, rows, depth=8, colour=0, before=b"", interlaced=0):
    head = struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, interlaced)
    return (b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", head) + before + png_chunk(b"IDAT", zlib.compress(rows, 9))
            + png_chunk(b"IEND", b""))


def jpeg(width, height, scans=1, progressive=False):
    """A grey JPEG image, whose scans consist of a header and a few bytes."""
    quantisation = b"\xff\xdb\x00\x43\x00" + bytes([1] * 64)
    frame = (b"\xff\xc2" if progressive else b"\xff\xc0") + struct.pack(">HBHHBBBB", 11, 8, height, width, 1, 1, 0x11, 0)
    dc = b"\xff\xc4" + struct.pack(">H", 2 + 17 + 1) + b"\x00" + bytes([1] + [0] * 15) + b"\x00"
    ac = b"\xff\xc4" + struct.pack(">H", 2 + 17 + 2) + b"\x10" + bytes([1, 1] + [0] * 14) + b"\x00\xe0"
    image = b"\xff\xd8" + quantisation + frame + dc + ac
    for i in range(scans):
        first, last = (0, 0) if not progressive or i == 0 else (1, 63)
        if not progressive:
            last = 63
        image += b"\xff\xda" + struct.pack(">HBBBBBB", 8, 1, 1, 0, first, last, 0) + bytes(40)
    return image + b"\xff\xd9"


# LCM logs.


def lcm_event(number, channel, data, length=None):
    said = len(data) if length is None else length
    return b"\xed\xa1\xda\x01" + struct.pack(">qqII", number, 1_000_000 + number, len(channel), said) + channel + data


def lcm_events(log):
    """Yields (channel, data) of each event of a sound log, which may be cut off."""
    at = 0
    while at + 28 <= len(log):
        channel, data = struct.unpack(">II", log[at + 20:at + 28])
        yield log[at + 28:at + 28 + channel], log[at + 28 + channel:at + 28 + channel + data]
        at += 28 + channel + data


def with_document(log, name, text):
    """Replaces the text of the document `name` in a log. A document message ends with the size and the bytes of its
    text."""
    made = b""
    named = name.encode() + b"\0"
    for number, (channel, data) in enumerate(lcm_events(log)):
        place = data.find(named) if channel.endswith(b"DOCUMENT") else -1
        if place >= 0:
            data = data[:place + len(named)] + struct.pack(">I", len(text)) + text
        made += lcm_event(number, channel, data)
    return made
