#!/usr/bin/env python3
"""Tests whether a message to a multicast group with a time to live of 0 comes back to this machine.

usage: multicast_comes_back.py GROUP PORT      exit code 0: it does, 1: it does not
"""

import os
import socket
import sys
import time

PATIENCE_S = 0.5


def comes_back(group, port):
    word = os.urandom(16)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver, \
         socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        receiver.bind((group, port))
        membership = socket.inet_aton(group) + socket.inet_aton("0.0.0.0")
        receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)
        sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
        sender.sendto(word, (group, port))
        receiver.settimeout(PATIENCE_S)
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:  # other programs may send to this group
            if receiver.recv(2048) == word:
                return True
    return False


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: multicast_comes_back.py GROUP PORT")
    try:
        sys.exit(0 if comes_back(sys.argv[1], int(sys.argv[2])) else 1)
    except OSError:  # no route, no such network, or no message in time
        sys.exit(1)
