#!/usr/bin/env python3
"""Writes a bag of odometry and images with the Python library rosbag, which makes the message types from their
definitions.

usage: python_bag.py FILE none|bz2|lz4      exit code 77: rosbag is missing
"""

import sys

try:
    import genpy
    import genpy.dynamic
    import rosbag
except ImportError as missing:
    print(missing)
    sys.exit(77)

HEADER = """
================================================================================
MSG: std_msgs/Header
uint32 seq
time stamp
string frame_id
"""

POSE = """Header header
Pose pose
""" + HEADER + """
================================================================================
MSG: geometry_msgs/Pose
Point position
Quaternion orientation

================================================================================
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z

================================================================================
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
"""

IMAGE = """Header header
uint32 height
uint32 width
string encoding
uint8 is_bigendian
uint32 step
uint8[] data
""" + HEADER


def main(file, compression):
    pose_type = genpy.dynamic.generate_dynamic("geometry_msgs/PoseStamped", POSE)["geometry_msgs/PoseStamped"]
    image_type = genpy.dynamic.generate_dynamic("sensor_msgs/Image", IMAGE)["sensor_msgs/Image"]
    with rosbag.Bag(file, "w", compression=compression, chunk_threshold=2000) as bag:
        for i in range(50):
            stamp = genpy.Time(1000 + i // 10, i % 10 * 100000000)
            pose = pose_type()
            pose.header.stamp = stamp
            pose.pose.position.x = 0.05 * i
            pose.pose.orientation.w = 1.0
            bag.write("/pose", pose, stamp)
            if i % 10 == 0:
                image = image_type()
                image.header.stamp = stamp
                image.width, image.height, image.step, image.encoding = 4, 3, 4, "mono8"
                image.data = bytes(range(12))
                bag.write("/camera/image_raw", image, stamp)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
