# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Draws the grid of cameras and the plane of zero disparity in the viewport. All views see the same
rectangle of that plane."""

import bpy
import gpu
from gpu_extras.batch import batch_for_shader
from mathutils import Vector

from . import measured, plan
from .visible_depth import camera_axes

GRID_COLOR = (1.0, 0.62, 0.1, 1.0)
RAY_COLOR = (1.0, 0.62, 0.1, 0.35)
PLANE_COLOR = (0.2, 0.75, 1.0, 1.0)


def grid_lines(grid, axes):
    """Ends of the lines between neighboring cameras, in the world; of a single one, none."""

    def place(row, column):
        return axes @ Vector((*grid.offset(row, column), 0))

    ends = []
    for row in range(grid.rows):
        for column in range(grid.columns):
            if column + 1 < grid.columns:
                ends += [place(row, column), place(row, column + 1)]
            if row + 1 < grid.rows:
                ends += [place(row, column), place(row + 1, column)]
    return ends


def plane_corners(grid, axes, camera):
    """The rectangle of the zero plane that every view shows."""
    lens = grid.lens
    width = lens.extent * grid.zero_plane
    height = width * lens.height / lens.width
    shift = lens.shift_unit * grid.zero_plane
    x, y = camera.data.shift_x * shift, camera.data.shift_y * shift
    corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
    return [axes @ Vector((x + i * width, y + j * height, -grid.zero_plane)) for i, j in corners]


def ray_lines(grid, axes, corners):
    """From the cameras at the corners of the grid to the corners of the plane."""
    last_row, last_column = grid.rows - 1, grid.columns - 1
    cameras = [(last_row, 0), (last_row, last_column), (0, last_column), (0, 0)]
    ends = []
    for view, corner in zip(cameras, corners):
        ends += [axes @ Vector((*grid.offset(*view), 0)), corner]
    return ends


def _draw_lines(ends, color):
    if not ends:
        return
    name = "3D_UNIFORM_COLOR" if bpy.app.version < (3, 5, 0) else "UNIFORM_COLOR"
    shader = gpu.shader.from_builtin(name)
    batch = batch_for_shader(shader, "LINES", {"pos": ends})
    shader.bind()
    shader.uniform_float("color", color)
    batch.draw(shader)


def _draw():
    scene = bpy.context.scene
    camera = scene.camera
    if camera is None or camera.type != "CAMERA" or not camera.data.episcope.shows_grid:
        return
    depsgraph = bpy.context.evaluated_depsgraph_get()
    try:
        plan.light_field_camera(scene)
        grid = measured.grid(camera.data.episcope, scene, camera, depsgraph)
    except plan.BadSettings:
        return  # the panel says so
    if grid is None:
        return
    axes = camera_axes(camera, depsgraph)
    corners = plane_corners(grid, axes, camera)
    gpu.state.blend_set("ALPHA")
    gpu.state.line_width_set(1.5)
    _draw_lines(grid_lines(grid, axes), GRID_COLOR)
    _draw_lines(ray_lines(grid, axes, corners), RAY_COLOR)
    around = [end for pair in zip(corners, corners[1:] + corners[:1]) for end in pair]
    _draw_lines(around, PLANE_COLOR)
    gpu.state.line_width_set(1)
    gpu.state.blend_set("NONE")


class _State:
    handler = None


def register():
    if not bpy.app.background:
        _State.handler = bpy.types.SpaceView3D.draw_handler_add(_draw, (), "WINDOW", "POST_VIEW")


def unregister():
    if _State.handler is not None:
        bpy.types.SpaceView3D.draw_handler_remove(_State.handler, "WINDOW")
        _State.handler = None
