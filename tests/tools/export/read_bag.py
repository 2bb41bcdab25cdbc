#!/usr/bin/env python3
"""Reads a bag with the Python library of ROS (Debian: python3-rosbag), which needs the index, and prints it as JSON.
The library decodes the messages with the definitions in the bag and computes the checksums of these definitions again.

usage: read_bag.py FILE      exit code 77: rosbag is missing
"""

import json
import sys

try:
    import genpy
    import genpy.dynamic
    import rosbag
except ImportError as missing:
    print(missing)
    sys.exit(77)


def plain(value):
    if isinstance(value, genpy.Message):
        return {name: plain(getattr(value, name)) for name in value.__slots__}
    if isinstance(value, (genpy.Time, genpy.Duration)):
        return {"sec": value.secs, "nanosec": value.nsecs}
    if isinstance(value, bytes):
        return list(value)
    if isinstance(value, (list, tuple)):
        return [plain(each) for each in value]
    return value


def main(path):
    topics = {}
    with rosbag.Bag(path) as bag:
        for connection in bag._get_connections():
            types = genpy.dynamic.generate_dynamic(connection.datatype, connection.msg_def)
            topics[connection.topic] = {"type": connection.datatype, "checksum": connection.md5sum,
                                        "worked_out": types[connection.datatype]._md5sum, "messages": []}
        for topic, message, time in bag.read_messages():
            topics[topic]["messages"].append({"time_ns": time.to_nsec(), "message": plain(message)})
        summary = {"begin_s": bag.get_start_time(), "end_s": bag.get_end_time(), "count": bag.get_message_count()}
    json.dump({"topics": topics, **summary}, sys.stdout)


if __name__ == "__main__":
    main(sys.argv[1])
