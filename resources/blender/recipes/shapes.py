# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Objects that the scenes are made of. Their materials' patterns lie in object coordinates, so
objects are built in their size and never scaled."""

import math

import bpy
from mathutils import Vector


LARGEST_CAP = 0.03  # radius


def add(name, vertices, faces, material, is_smooth=False):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(v) for v in vertices], [], faces)
    mesh.update()
    mesh.materials.append(material)
    if is_smooth:
        mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    target = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(target)
    return target


def place(target, location, rotation=(0, 0, 0)):
    """`rotation` in degrees."""
    target.location = location
    target.rotation_euler = [math.radians(angle) for angle in rotation]
    return target


def box(name, size, material, bevel=0.0):
    """Stands on the origin's plane: z from 0."""
    x, y, z = size[0] / 2, size[1] / 2, size[2]
    corners = [(sx * x, sy * y, sz) for sz in (0, z) for sy in (-1, 1) for sx in (-1, 1)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    target = add(name, corners, faces, material)
    if bevel > 0:
        rounding = target.modifiers.new("rounding", "BEVEL")
        rounding.width, rounding.segments = bevel, 2
    return target


def sheet(name, width, height, material):
    """A rectangle in the plane of x and z, that faces -y; z from 0."""
    x = width / 2
    return add(
        name, [(-x, 0, 0), (x, 0, 0), (x, 0, height), (-x, 0, height)], [(0, 1, 2, 3)], material
    )


def turned(name, profile, material, steps=64):
    """A surface of revolution about z; `profile`: (radius, z) from below. Small ends are closed."""
    vertices = [
        (r * math.cos(2 * math.pi * i / steps), r * math.sin(2 * math.pi * i / steps), z)
        for r, z in profile
        for i in range(steps)
    ]
    faces = [
        (
            j * steps + i,
            j * steps + (i + 1) % steps,
            (j + 1) * steps + (i + 1) % steps,
            (j + 1) * steps + i,
        )
        for j in range(len(profile) - 1)
        for i in range(steps)
    ]
    if profile[0][0] < LARGEST_CAP:
        faces.append(tuple(reversed(range(steps))))
    if profile[-1][0] < LARGEST_CAP:
        faces.append(tuple(range(len(vertices) - steps, len(vertices))))
    return add(name, vertices, faces, material, is_smooth=True)


def smoothed(profile, steps=6):
    """A Catmull-Rom curve through the points of a profile."""
    points = [Vector(p) for p in (profile[0], *profile, profile[-1])]
    curve = []
    for a, b, c, d in zip(points, points[1:], points[2:], points[3:]):
        for i in range(steps):
            t = i / steps
            curve.append(
                0.5
                * (
                    2 * b
                    + (c - a) * t
                    + (2 * a - 5 * b + 4 * c - d) * t**2
                    + (3 * b - a - 3 * c + d) * t**3
                )
            )
    return [tuple(p) for p in curve] + [tuple(profile[-1])]


def ball(name, radius, material, steps=48):
    """Lies on the origin's plane."""
    angles = [math.pi * (0.002 + 0.996 * i / (steps // 2)) for i in range(steps // 2 + 1)]
    profile = [(radius * math.sin(a), radius * (1 - math.cos(a))) for a in angles]
    return turned(name, profile, material, steps)


def rod(name, points, radius, material, end_radius=None):
    """A round bar or twig along points, which may become thinner."""
    curve = bpy.data.curves.new(name, "CURVE")
    curve.dimensions = "3D"
    curve.bevel_depth = radius
    curve.bevel_resolution = 2
    curve.use_fill_caps = True
    spline = curve.splines.new("POLY")
    spline.points.add(len(points) - 1)
    thinnest = 1.0 if end_radius is None else end_radius / radius
    for i, (point, target) in enumerate(zip(spline.points, points)):
        point.co = (*target, 1)
        point.radius = 1 + (thinnest - 1) * i / max(1, len(points) - 1)
    curve.materials.append(material)
    target = bpy.data.objects.new(name, curve)
    bpy.context.scene.collection.objects.link(target)
    return target


def joined(name, targets):
    """One object of several, so that they share a label. Curves become meshes."""
    vertices, faces, slots, materials, smooth = [], [], [], [], []
    depsgraph = bpy.context.evaluated_depsgraph_get()
    for target in targets:
        evaluated = target.evaluated_get(depsgraph)
        mesh = evaluated.to_mesh()
        first = len(vertices)
        vertices += [evaluated.matrix_world @ v.co for v in mesh.vertices]
        material = target.data.materials[0]
        if material not in materials:
            materials.append(material)
        for polygon in mesh.polygons:
            faces.append([first + i for i in polygon.vertices])
            slots.append(materials.index(material))
            smooth.append(polygon.use_smooth)
        evaluated.to_mesh_clear()
    whole = add(name, vertices, faces, materials[0])
    for material in materials[1:]:
        whole.data.materials.append(material)
    whole.data.polygons.foreach_set("material_index", slots)
    whole.data.polygons.foreach_set("use_smooth", smooth)
    for target in targets:
        bpy.data.objects.remove(target)
    return whole
