# SPDX-License-Identifier: Apache-2.0
"""Pictures in and out: the OpenEXR files that gltfx writes are read; textures (PNG) and
environments (Radiance HDR) are written."""
import math
import struct
import zlib


class Picture:
    """Rows from the top, each a list of pixels, each a tuple of channels: R, G, B, A."""

    def __init__(self, rows):
        self.rows = rows
        self.width, self.height = len(rows[0]), len(rows)

    def at(self, x, y):
        return self.rows[y][x]

    def mean(self):
        pixels = [pixel for row in self.rows for pixel in row]
        return tuple(math.fsum(channel) / len(pixels) for channel in zip(*pixels))


# OpenEXR: "The OpenEXR File Layout". gltfx writes scan lines, 32-bit floats, ZIP or no compression.

LONG_NAMES = 0x400  # a flag that Blender sets
LINES_IN_BLOCK = {0: 1, 2: 1, 3: 16}  # by compression: none, ZIPS, ZIP
FLOAT = 2


def text_at(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def header_of(data):
    """(attributes by name, where the offset table begins)"""
    magic, version = struct.unpack_from("<II", data)
    if magic != 20000630 or version not in (2, 2 | LONG_NAMES):
        raise ValueError("not a plain OpenEXR file")
    attributes, at = {}, 8
    while data[at]:
        name, at = text_at(data, at)
        _, at = text_at(data, at)
        size = struct.unpack_from("<I", data, at)[0]
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def channels_of(value):
    names, at = [], 0
    while value[at]:
        name, at = text_at(value, at)
        if struct.unpack_from("<I", value, at)[0] != FLOAT:
            raise ValueError(f"channel {name} is not float")
        names.append(name)
        at += 16
    return names


def unzipped(data):
    """Undoes zlib, then differences of neighbors, then the split of even and odd bytes."""
    packed = bytearray(zlib.decompress(data))
    for i in range(1, len(packed)):
        packed[i] = (packed[i - 1] + packed[i] - 128) & 255
    half = (len(packed) + 1) // 2
    result = bytearray(len(packed))
    result[0::2], result[1::2] = packed[:half], packed[half:]
    return bytes(result)


def read_exr(data):
    attributes, table = header_of(data)
    names = channels_of(attributes["channels"])
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    lines = LINES_IN_BLOCK[attributes["compression"][0]]
    order = [names.index(name) for name in "RGBA" if name in names]
    rows = [None] * height
    for offset in struct.unpack_from(f"<{-(-height // lines)}Q", data, table):
        first, size = struct.unpack_from("<iI", data, offset)
        first -= top
        count = min(lines, height - first)
        block = data[offset + 8:offset + 8 + size]
        if size < count * width * len(names) * 4:
            block = unzipped(block)
        for y in range(count):
            planes = [struct.unpack_from(f"<{width}f", block, (y * len(names) + c) * width * 4)
                      for c in order]
            rows[first + y] = list(zip(*planes))
    return Picture(rows)


# PNG (ISO/IEC 15948), without filters.

def png(rows):
    """Rows of pixels, each a tuple of one to four bytes."""
    channels = len(rows[0][0])
    kind = {1: 0, 2: 4, 3: 2, 4: 6}[channels]

    def chunk(name, content):
        body = name + content
        return struct.pack(">I", len(content)) + body + struct.pack(">I", zlib.crc32(body))

    lines = b"".join(b"\0" + bytes(value for pixel in row for value in pixel) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" +
            chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, kind, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))


# Radiance HDR (Ward, "Real Pixels", Graphics Gems II): three mantissas of 8 bits, one exponent.

def rgbe(color):
    most = max(color)
    if most < 1e-32:
        return bytes(4)
    mantissa, exponent = math.frexp(most)
    scale = mantissa * 256 / most
    return bytes([int(c * scale) for c in color] + [exponent + 128])


def hdr(rows):
    """Rows of colors, without run lengths: fewer than 8 in a row, or else they would be taken for
    such. Eight bits of a brightness are kept."""
    head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {len(rows)} +X {len(rows[0])}\n"
    return head.encode() + b"".join(rgbe(color) for row in rows for color in row)
