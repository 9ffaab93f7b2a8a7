# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Reads the uncompressed 32-bit OpenEXR files that Blender writes of its passes: bpy gives no
access to the pixels of files with several layers."""

import struct

import numpy

MAGIC = 20000630
FLOAT = 2
UNCOMPRESSED = 0
INCREASING_Y = 0


class UnreadableExr(Exception):
    """The file is not of the one kind that is read here."""


def _text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode("utf-8"), end + 1


def _attributes(data):
    """Values of the header as bytes, by name, and where the header ends."""
    magic, _ = struct.unpack_from("<II", data, 0)
    if magic != MAGIC:
        raise UnreadableExr("no OpenEXR file")
    at, attributes = 8, {}
    while data[at] != 0:
        name, at = _text(data, at)
        _, at = _text(data, at)
        (size,) = struct.unpack_from("<I", data, at)
        attributes[name] = data[at + 4 : at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def _channel_names(chlist):
    at, names = 0, []
    while chlist[at] != 0:
        name, at = _text(chlist, at)
        kind, _, x_step, y_step = struct.unpack_from("<iIii", chlist, at)
        if (kind, x_step, y_step) != (FLOAT, 1, 1):
            raise UnreadableExr(f"channel {name} is not of 32-bit floats")
        names.append(name)
        at += 16
    return names


def read_passes(path):
    """Arrays [y][x] of 32-bit floats, y downwards, by what follows the layer's name: "Depth.Z"."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, at = _attributes(data)
    if attributes["compression"][0] != UNCOMPRESSED or attributes["lineOrder"][0] != INCREASING_Y:
        raise UnreadableExr("compressed, or its lines are in another order")
    names = _channel_names(attributes["channels"])
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    at += 8 * height  # offsets of lines, which follow each other
    line_floats = 2 + width * len(names)  # y and the size come before the samples
    lines = numpy.frombuffer(data, "<f4", height * line_floats, at).reshape(height, line_floats)
    samples = lines[:, 2:].reshape(height, len(names), width)
    return {name.split(".", 1)[-1]: samples[:, i].copy() for i, name in enumerate(names)}
