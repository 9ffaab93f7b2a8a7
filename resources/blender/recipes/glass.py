# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""A printed glass pane in a frame before a textured room: two surfaces in one pixel."""

import bpy

from . import materials, shapes, stage

TRANSPARENT = "Transparent"


def _room(random):
    floor = materials.checks("floor", stage.hue(random, 0.5, 0.4), (0.65, 0.62, 0.55), size=0.45)
    wall = materials.mottled("wall", stage.hue(random, 0.55, 0.4), size=0.3, contrast=0.5)
    side = materials.stripes("side wall", [stage.hue(random, 0.4), (0.65, 0.6, 0.5)], 0.5, "X")
    shapes.place(shapes.box("floor", (9, 6, 0.1), floor), (0, 1.5, -0.1))
    shapes.place(shapes.sheet("wall", 9, 5, wall), (0, 3.2, 0))
    shapes.place(shapes.sheet("side wall", 8, 5, side), (-2.4, 1, 0), (0, 0, 75))


def _things(random):
    for i in range(4):
        size = (random.uniform(0.4, 0.8), random.uniform(0.4, 0.7), random.uniform(0.4, 1.3))
        cover = materials.mottled(f"box {i + 1}", stage.hue(random, 0.5), size=0.12)
        shapes.place(
            shapes.box(f"box {i + 1}", size, cover, 0.015),
            (-1.4 + i * 0.95, random.uniform(0.9, 2.3), 0),
            (0, 0, random.uniform(-40, 40)),
        )
    for i in range(4):
        skin = materials.speckled(
            f"ball {i + 1}", stage.hue(random, 0.6), (0.08, 0.08, 0.1), size=0.12
        )
        shapes.place(
            shapes.ball(f"ball {i + 1}", random.uniform(0.18, 0.3), skin),
            (random.uniform(-1.3, 1.3), random.uniform(0.4, 1.0), 0),
            (random.uniform(0, 60), 20, 0),
        )


def _pane(random):
    glass = materials.pane(
        "glass", stage.hue(random, 0.8, 0.7), opacity=random.uniform(0.35, 0.5), size=0.16
    )
    turn = random.uniform(-12, 12)
    pane = shapes.place(shapes.sheet("pane", 1.7, 1.5, glass), (0.1, -0.8, 0.35), (0, 0, turn))
    collection = bpy.data.collections.new(TRANSPARENT)
    bpy.context.scene.collection.children.link(collection)
    bpy.context.scene.collection.objects.unlink(pane)
    collection.objects.link(pane)
    wood = materials.wood("frame", (0.3, 0.17, 0.08), size=0.07)
    bars = [
        ((1.86, 0.07, 0.08), (0, -0.08)),
        ((1.86, 0.07, 0.08), (0, 1.5)),
        ((0.08, 0.07, 1.5), (-0.89, 0)),
        ((0.08, 0.07, 1.5), (0.89, 0)),
    ]
    for i, (size, (x, z)) in enumerate(bars):
        bar = shapes.box(f"frame {i + 1}", size, wood)
        bar.parent = pane
        bar.location = (x, 0, z)
    return collection


def build(random):
    _room(random)
    _things(random)
    collection = _pane(random)
    stage.lamp((-1.5, -3.0, 3.6), (0, 1, 0.5), 1.2, 260, (1, 0.95, 0.88))
    stage.lamp((1.5, 1.5, 3.8), (0, 1.5, 0), 1.0, 120)
    stage.sky((0.8, 0.88, 1), 0.45)
    camera = stage.camera((random.uniform(-0.3, 0.3), -4.2, 1.25), (0, 0, 0.95), focal_mm=52)
    camera.data.episcope.transparent = collection
