#!/usr/bin/env python3
"""Checks that azimuth-ros2 --interface lo sends nothing beyond the machine. In a network namespace with a virtual
cable, the test listens at the far end of the cable. Without the option, DDS must announce itself there.

usage: stays_here.py AZIMUTH_ROS2      exit code 0: good, 1: not, 77: the cable cannot be made
"""

import os
import socket
import subprocess
import sys
import time

PROGRAM = sys.argv[1]
DISCOVERY = 7400  # discovery port of DDS in domain 0
ANY_PROTOCOL, IPV4, UDP = 3, b"\x08\x00", 17


def lay_cable():
    commands = ("ip link add here type veth peer name there", "ip addr add 10.9.9.1/24 dev here",
                "ip link set here up multicast on", "ip link set there up")
    for command in commands:
        made = subprocess.run(command.split(), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if made.returncode:
            print(f"SKIPPED: {command}: {made.stdout.strip()}")
            sys.exit(77)


def is_discovery(packet):
    return packet[12:14] == IPV4 and packet[23] == UDP and int.from_bytes(packet[36:38], "big") == DISCOVERY


def heard(options, variables, limit_s, enough):
    """Counts the discovery packets of DDS at the far end until there are `enough`, or until `limit_s`."""
    end = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(ANY_PROTOCOL))
    end.bind(("there", 0))
    end.settimeout(0.1)
    program = subprocess.Popen([PROGRAM, *options], stderr=subprocess.PIPE, text=True, env=os.environ | variables)
    count, until = 0, time.monotonic() + limit_s
    while time.monotonic() < until and count < enough:
        try:
            count += is_discovery(end.recv(2048))
        except TimeoutError:
            pass
    program.terminate()
    said = program.communicate(timeout=30)[1]
    if program.returncode != 0 or "publishes in domain 0" not in said:
        sys.exit(f"azimuth-ros2 ends with {program.returncode}: {said}")
    return count


def main():
    lay_cable()
    for options, variables in ((["--interface", "lo"], {}), ([], {"ROS_LOCALHOST_ONLY": "1"})):
        if count := heard(options, variables, 2.0, 1):
            sys.exit(f"{count} packets left the machine with {options} {variables}")
    if not heard([], {}, 20.0, 1):
        sys.exit("nothing is heard without the option either: this test cannot fail")


if __name__ == "__main__":
    main()
