# SPDX-License-Identifier: Apache-2.0
"""Vectors as tuples, colors too, and the rotations that turn cameras and lights."""
import math


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def times(factor, a):
    return tuple(factor * x for x in a)


def plus(*all_of):
    return tuple(map(sum, zip(*all_of)))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalize(a):
    return times(1 / math.sqrt(dot(a, a)), a)


def each(function, *colors):
    """The function of each channel of colors; plain numbers are grey."""
    full = [color if isinstance(color, tuple) else (color,) * 3 for color in colors]
    return tuple(function(*channels) for channels in zip(*full))


def direction(polar, azimuth=0.0):
    """In degrees: from +z, then around it from +x."""
    p, a = math.radians(polar), math.radians(azimuth)
    return (math.sin(p) * math.cos(a), math.sin(p) * math.sin(a), math.cos(p))


def turn(axis, degrees):
    """A rotation as a quaternion."""
    half = math.radians(degrees) / 2
    return [*times(math.sin(half), axis), math.cos(half)]


def facing(target):
    """The shortest rotation of +z to a direction other than -z. Cameras and lights look along
    their own -z, so one in that direction looks at the origin."""
    x, y, z = normalize(target)
    length = math.sqrt(2 + 2 * z)
    return [-y / length, x / length, 0.0, length / 2]


def rotated(vector, quaternion):
    *axis, w = quaternion
    once = plus(cross(axis, vector), times(w, vector))
    return plus(vector, times(2, cross(axis, once)))
