# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""What a camera sees, measured without rendering."""

from mathutils import Vector

from .camera_grid import Lens

RAYS_A_SIDE = 128


def resolution(scene):
    percent = scene.render.resolution_percentage
    return (
        max(1, scene.render.resolution_x * percent // 100),
        max(1, scene.render.resolution_y * percent // 100),
    )


def lens_of(scene, camera):
    """The lens of a perspective camera object; pixels are square."""
    width, height = resolution(scene)
    corners = camera.data.view_frame(scene=scene)
    distance = -corners[0].z
    across = (max(c.x for c in corners) - min(c.x for c in corners)) / distance
    upright = (max(c.y for c in corners) - min(c.y for c in corners)) / distance
    unit = {"HORIZONTAL": across, "VERTICAL": upright}.get(
        camera.data.sensor_fit, max(across, upright)
    )
    return Lens(width=width, height=height, extent=across, shift_unit=unit)


def camera_axes(camera, depsgraph):
    """The place and directions of a camera, without its scale."""
    matrix = camera.evaluated_get(depsgraph).matrix_world
    rotation = matrix.to_quaternion().to_matrix().to_4x4()
    rotation.translation = matrix.to_translation()
    return rotation


def visible_range(scene, camera, depsgraph):
    """The nearest and the farthest depth along the optical axis on a grid of rays; None if they all
    meet nothing. Thin objects between the rays are missed."""
    axes = camera_axes(camera, depsgraph)
    corners = camera.data.view_frame(scene=scene)
    scale = 1 / -corners[0].z
    left, right = (f(c.x * scale for c in corners) for f in (min, max))
    bottom, top = (f(c.y * scale for c in corners) for f in (min, max))
    origin = axes.translation
    to_world = axes.to_3x3()
    forward = to_world @ Vector((0, 0, -1))
    near, far = float("inf"), 0.0
    for j in range(RAYS_A_SIDE):
        y = bottom + (top - bottom) * (j + 0.5) / RAYS_A_SIDE
        for i in range(RAYS_A_SIDE):
            x = left + (right - left) * (i + 0.5) / RAYS_A_SIDE
            direction = (to_world @ Vector((x, y, -1))).normalized()
            is_hit, place, *_ = scene.ray_cast(depsgraph, origin, direction)
            if is_hit:
                depth = (place - origin).dot(forward)
                near, far = min(near, depth), max(far, depth)
    return (near, far) if far > 0 else None
