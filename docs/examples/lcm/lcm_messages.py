"""Receives LCM messages in pure Python, because Debian 12 has no LCM module for Python. All messages of Azimuth except
features with descriptors fit into one datagram, so no fragments have to be joined."""

import socket
import struct

SHORT_MESSAGE = 0x4C433032  # "LC02"


def messages(group="239.255.76.67", port=7667):
    """Yields (channel, bytes) of each received message, for ever."""
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    receiver.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 21)
    receiver.bind((group, port))
    receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, socket.inet_aton(group) + socket.inet_aton("0.0.0.0"))
    return read(receiver)


def read(receiver):
    while True:
        datagram = receiver.recv(65536)
        if len(datagram) < 9 or struct.unpack_from(">I", datagram)[0] != SHORT_MESSAGE:
            continue
        channel, found, payload = datagram[8:].partition(b"\0")
        if found:
            yield channel.decode(errors="replace"), payload
