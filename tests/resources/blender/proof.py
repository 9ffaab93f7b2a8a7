# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""What the proofs share: a scene of planes and spheres, its exact depth, and files of a light
field."""

import json
import math
import os
import shutil
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "..", "..", "resources", "blender")]

import bpy
import numpy
from mathutils import Matrix, Vector

from episcope_light_field import headless, script
from recipes import materials, shapes, stage

# Where the camera stands and what it sees, in its own coordinates: x right, y up, z backwards.
CAMERA = Matrix.Translation((1, -2, 3)) @ Matrix.Rotation(0.7, 4, (0.3, 1, -0.4))
WALL_DEPTH = 9.0
SLOPE = (0.35, -0.2, 1.0)  # normal of the slanted plane, whose middle is at SLANTED
SLANTED = (-1.0, 0.6, -6.5)
SLANTED_SIZE = 1.6
SPHERES = (((0.9, 0.7, -5.5), 0.6), ((0.5, -1.0, -7.0), 0.8))


def arguments(count):
    given = script.arguments() or []
    if len(given) != count:
        sys.exit(f"expected {count} arguments, got {given}")
    return given


def fresh_folder(path):
    shutil.rmtree(path, ignore_errors=True)
    os.makedirs(path)
    return path


def _placed(target, local):
    target.matrix_world = CAMERA @ local
    return target


def build_scene():
    """A wall, a slanted square and two spheres that touch nothing else."""
    script.make_available()
    scene = stage.clear()
    texture = materials.mottled("texture", (0.5, 0.4, 0.3), size=0.5, contrast=0.7, roughness=1)
    wall = shapes.sheet("wall", 30, 30, texture)
    upright = Matrix.Rotation(math.radians(-90), 4, "X")
    _placed(wall, Matrix.Translation((0, -15, -WALL_DEPTH)) @ upright)
    facing = Vector(SLOPE).to_track_quat("Z", "Y").to_matrix().to_4x4()
    half = SLANTED_SIZE / 2
    corners = [(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)]
    square = shapes.add("square", corners, [(0, 1, 2, 3)], texture)
    _placed(square, Matrix.Translation(SLANTED) @ facing)
    for i, (center, radius) in enumerate(SPHERES):
        ball = shapes.ball(f"ball {i}", radius, texture, steps=512)
        _placed(ball, Matrix.Translation(Vector(center) - Vector((0, 0, radius))))
    stage.sky((1, 1, 1), 0.8)
    camera = stage.camera((0, 0, 0), (0, 0, -1), focal_mm=40)
    camera.matrix_world = CAMERA
    bpy.context.view_layer.update()
    return scene


def _rays(manifest, view):
    """Directions (x, y, -1) of the pixels of a view, and where its camera stands."""
    grid, size, camera = manifest["grid"], manifest["size"], manifest["camera"]
    step = camera["baseline"]
    x0 = step * (view[1] - grid["columns"] // 2)
    y0 = -step * (view[0] - grid["rows"] // 2)
    x = (numpy.arange(size["width"]) + 0.5 - camera["principal_point_px"][0]) / camera[
        "focal_length_px"
    ]
    y = (numpy.arange(size["height"]) + 0.5 - camera["principal_point_px"][1]) / camera[
        "focal_length_px"
    ]
    x, y = numpy.meshgrid(x - x0 / camera["zero_plane"], -y - y0 / camera["zero_plane"])
    return numpy.stack([x, y, -numpy.ones_like(x)], axis=-1), numpy.array([x0, y0, 0.0])


def _sphere_depth(rays, origin, center, radius):
    to_center = numpy.array(center) - origin
    a = (rays**2).sum(-1)
    b = rays @ to_center
    inside = b**2 - a * (to_center @ to_center - radius**2)
    return numpy.where(inside > 0, (b - numpy.sqrt(numpy.maximum(inside, 0))) / a, numpy.inf)


def _square_depth(rays, origin):
    facing = numpy.array(Vector(SLOPE).to_track_quat("Z", "Y").to_matrix())
    middle = numpy.array(SLANTED) - origin
    normal = facing[:, 2]
    depth = (middle @ normal) / (rays @ normal)
    local = (rays * depth[..., None] - middle) @ facing
    is_inside = (abs(local[..., :2]) < SLANTED_SIZE / 2).all(-1)
    return numpy.where(is_inside, depth, numpy.inf)


def exact(manifest, view):
    """Depth of every pixel's center, and which surface it is: 0 wall, 1 square, 2 and 3 spheres."""
    rays, origin = _rays(manifest, view)
    depths = [numpy.full(rays.shape[:2], WALL_DEPTH), _square_depth(rays, origin)]
    depths += [_sphere_depth(rays, origin, *sphere) for sphere in SPHERES]
    return numpy.min(depths, axis=0), numpy.argmin(depths, axis=0)


def away_from_edges(surface, reach=2):
    """Where all pixels around are of the same surface."""
    same = numpy.ones(surface.shape, bool)
    for dy in range(-reach, reach + 1):
        for dx in range(-reach, reach + 1):
            same &= surface == numpy.roll(surface, (dy, dx), (0, 1))
    same[:reach] = same[-reach:] = False
    same[:, :reach] = same[:, -reach:] = False
    return same


def render(scene, folder, *options):
    """As by the command line. Gives the manifest."""
    given = headless.parser().parse_args(["--out", folder, "--threads", "2", *options])
    code = headless.render(scene, given)
    assert code == 0, f"rendering ended with {code}"
    return manifest_of(folder)


def manifest_of(folder):
    with open(os.path.join(folder, "light_field.json"), encoding="utf-8") as file:
        return json.load(file)


def array(folder, manifest, part, view):
    name = manifest["files"][part].format(row=view[0], column=view[1])
    return numpy.load(os.path.join(folder, name))


def picture(folder, manifest, view):
    """Samples of a view as stored, from 0 to 255, [y][x][3]."""
    name = manifest["files"]["views"].format(row=view[0], column=view[1])
    image = bpy.data.images.load(os.path.join(folder, name), check_existing=False)
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    samples = numpy.empty(width * height * 4, numpy.float32)
    image.pixels.foreach_get(samples)
    bpy.data.images.remove(image)
    return 255 * samples.reshape(height, width, 4)[::-1, :, :3]


def disparity(manifest, depth):
    camera = manifest["camera"]
    scale = camera["baseline"] * camera["focal_length_px"]
    return scale * (1 / depth - 1 / camera["zero_plane"])


def sampled(image, x, y):
    """Cubic (Catmull-Rom) interpolation of [y][x][c] at places inside of the border of 2 px."""
    x0, y0 = numpy.floor(x).astype(int), numpy.floor(y).astype(int)

    def weights(t):
        t = t[..., None]
        return (-0.5 * t + t**2 - 0.5 * t**3, 1 - 2.5 * t**2 + 1.5 * t**3,
                0.5 * t + 2 * t**2 - 1.5 * t**3, -0.5 * t**2 + 0.5 * t**3)  # fmt: skip

    total = 0
    for j, wy in enumerate(weights(y - y0)):
        for i, wx in enumerate(weights(x - x0)):
            total = total + wy * wx * image[y0 + j - 1, x0 + i - 1]
    return total
