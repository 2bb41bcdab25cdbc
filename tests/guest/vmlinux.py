#!/usr/bin/env python3
"""Extracts the ELF kernel from a bzImage whose payload is compressed with xz, as in Debian.

usage: vmlinux.py BZIMAGE VMLINUX
"""

import lzma
import struct
import sys

SETUP_SECTORS = 0x1F1  # offsets into the boot header (Linux, Documentation/arch/x86/boot.rst)
PAYLOAD = 0x248
XZ_MAGIC = b"\xfd7zXZ\0"


def vmlinux(image):
    sectors = image[SETUP_SECTORS] or 4
    offset, length = struct.unpack_from("<II", image, PAYLOAD)
    payload = image[(sectors + 1) * 512 + offset:][:length]
    if not payload.startswith(XZ_MAGIC):
        raise SystemExit(f"vmlinux.py: the kernel's payload begins with {payload[:6].hex()}, not with xz's magic number")
    return lzma.LZMADecompressor().decompress(payload)


if __name__ == "__main__":
    with open(sys.argv[1], "rb") as source, open(sys.argv[2], "wb") as target:
        target.write(vmlinux(source.read()))
