#!/usr/bin/env python3
"""Listens to azimuthd: prints a line for each pose and for each new map.

lcm-gen -p --ppath . /usr/share/azimuth/lcmtypes/pose_cov_t.lcm /usr/share/azimuth/lcmtypes/map_chunk_t.lcm
/usr/share/azimuth/lcmtypes/landmark_t.lcm PYTHONPATH=. python3 listen.py """

import math

from azimuth import map_chunk_t, pose_cov_t
from lcm_messages import messages


class Map:
    """Collects the pieces of a map, which is complete when all pieces with one sequence number have arrived."""

    def __init__(self):
        self.number, self.pieces = None, {}

    def add(self, piece):
        """Adds a piece; returns the landmarks if the map is complete, else None."""
        if piece.seq != self.number:
            self.number, self.pieces = piece.seq, {}
        self.pieces[piece.chunk] = piece.landmarks
        if len(self.pieces) < piece.chunks:
            return None
        return [landmark for chunk in sorted(self.pieces) for landmark in self.pieces[chunk]]


def pose_line(pose):
    sigma_m = math.sqrt(pose.covariance[0] + pose.covariance[4])
    warning = "  do not steer by it" if pose.health == pose_cov_t.HEALTH_LOST else ""
    return (f"step {pose.step}  x {pose.x_m:.3f} y {pose.y_m:.3f} m  heading {pose.heading_rad:.3f} rad  +-{sigma_m:.3f} m{warning}")


def main():
    newest, received = Map(), messages()
    print("listening", flush=True)
    for channel, payload in received:
        if channel == "AZIMUTH_POSE":
            pose = pose_cov_t.decode(payload)
            if not pose.predicted:  # predicted poses come from odometry between two images
                print(pose_line(pose), flush=True)
        elif channel == "AZIMUTH_MAP_CHUNK":
            landmarks = newest.add(map_chunk_t.decode(payload))
            if landmarks is not None:
                print(f"map of {len(landmarks)} landmarks", flush=True)


if __name__ == "__main__":
    main()
