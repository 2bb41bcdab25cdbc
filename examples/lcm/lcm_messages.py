"""Receives LCM messages, with nothing but Python. Debian 12 has no LCM module for it, and Azimuth's messages need none: each
fits one datagram, but for features with descriptors."""

import socket
import struct

SHORT_MESSAGE = 0x4C433032  # "LC02"


def messages(group="239.255.76.67", port=7667):
    """(channel, bytes) of each message that comes, for ever."""
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
