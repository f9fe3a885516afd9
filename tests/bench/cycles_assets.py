# SPDX-License-Identifier: Apache-2.0
"""What against_cycles.py draws without assets: 25 balls, and a knot of 100,000 triangles."""
import math

from scene import Scene, Shape, lambert, material, perspective, quad, sphere
from vectors import cross, normalize, plus, times


def balls():
    """Metallic from 0 to 1 upwards, roughness from 0 to 1 to the right, before a wall."""
    scene = Scene()
    ball = sphere(0.21, 32)
    for row in range(5):
        for column in range(5):
            scene.draw(ball, material((0.8, 0.5, 0.3), row / 4, column / 4),
                       translation=[(column - 2) * 0.46, (row - 2) * 0.46, 0])
    scene.draw(quad(1.3), matte(doubleSided=True), translation=[0, 0, -0.4])
    return with_eye(scene)


def matte(**more):
    return lambert((0.6, 0.6, 0.6), extras={"nodes": "lambert"}, **more)


def with_eye(scene):
    scene.camera(perspective(0.6, aspectRatio=1), translation=[0, 0, 4.5])
    return scene


def knot(along=500, around=100):
    """A tube with ripples around a trefoil."""
    def center(t):
        return times(0.36, (math.sin(t) + 2 * math.sin(2 * t), math.cos(t) - 2 * math.cos(2 * t),
                            -math.sin(3 * t)))

    def point(i, j):
        t, a = 2 * math.pi * i / along, 2 * math.pi * j / around
        ahead = normalize(plus(center(t + 1e-4), times(-1, center(t - 1e-4))))
        side = normalize(cross(ahead, (0, 0, 1)))
        radius = 0.2 + 0.012 * math.sin(9 * a) * math.sin(60 * t)
        return plus(center(t), times(radius * math.cos(a), side),
                    times(radius * math.sin(a), cross(side, ahead)))

    points = [[point(i, j) for j in range(around)] for i in range(along)]
    positions, normals, triangles = [], [], []
    for i in range(along):
        for j in range(around):
            before, after = points[i - 1][j], points[(i + 1) % along][j]
            left, right = points[i][j - 1], points[i][(j + 1) % around]
            positions.append(points[i][j])
            normals.append(normalize(cross(plus(after, times(-1, before)),
                                           plus(right, times(-1, left)))))
            a, b = i * around + j, i * around + (j + 1) % around
            c, d = (index if i + 1 < along else index - along * around for index in
                    (a + around, b + around))
            triangles += [(a, d, b), (a, c, d)]
    return Shape(triangles, POSITION=positions, NORMAL=normals)


def model():
    scene = Scene()
    scene.draw(knot(), material((0.7, 0.5, 0.2), 1, 0.35))
    scene.draw(quad(1.6), matte(doubleSided=True), translation=[0, 0, -0.7])
    return with_eye(scene)
