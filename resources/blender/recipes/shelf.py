# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""A cluttered shelf: books, jars, wires, pencils, a plant, things that hang before it."""

import math

import bpy

from . import materials, shapes, stage

WIDTH, DEPTH, FLOORS, STEP = 3.2, 0.75, 3, 1.0


def _carcass(random):
    board = materials.wood("shelf wood", (0.5, 0.33, 0.18), size=0.1)
    back = random.choice(
        [
            materials.mottled("back", stage.hue(random, 0.5, 0.3), size=0.25, contrast=0.25),
            materials.stripes("back", [stage.hue(random, 0.5, 0.4), (0.6, 0.58, 0.5)], 0.16, "X"),
            materials.plain("back", stage.hue(random, 0.4, 0.3)),
        ]
    )
    shapes.place(shapes.sheet("back", 6, 5, back), (0, DEPTH / 2, -1))
    for i in range(FLOORS + 1):
        shapes.place(
            shapes.box(f"board {i + 1}", (WIDTH, DEPTH, 0.05), board), (0, 0, i * STEP - 0.05)
        )
    for i, x in enumerate((-WIDTH / 2, WIDTH / 2)):
        upright = shapes.box(f"side {i + 1}", (FLOORS * STEP + 0.1, DEPTH + 0.03, 0.05), board)
        shapes.place(upright, (x, 0, FLOORS * STEP / 2), (0, 90, 0))


def _books(random, x, end, z):
    """A row of upright books; the last one leans."""
    number = 0
    while x < end - 0.2:
        size = (random.uniform(0.07, 0.17), random.uniform(0.4, 0.55), random.uniform(0.5, 0.85))
        color = stage.hue(random, random.uniform(0.2, 0.6))
        cover = random.choice(
            [
                lambda: materials.plain("cover", color),
                lambda: materials.mottled("cover", color, size=0.05),
                lambda: materials.stripes("cover", [color, (0.7, 0.6, 0.3), color], 0.11, "Z"),
            ]
        )()
        book = shapes.box(f"book {z:g}.{number}", size, cover, 0.008)
        y = -DEPTH / 2 + size[1] / 2 + random.uniform(0.04, 0.16)
        shapes.place(book, (x + size[0] / 2, y, z))
        x += size[0] + 0.006
        number += 1
    leaning = shapes.box(
        f"leaning book {z:g}",
        (0.09, 0.45, 0.75),
        materials.mottled("cover", stage.hue(random, 0.5), size=0.05),
    )
    shapes.place(leaning, (x + 0.2, -0.08, z), (0, -14, 0))


def _jars(random, x, end, z):
    """From x to about `end`."""
    while x < end:
        r, h = random.uniform(0.1, 0.17), random.uniform(0.25, 0.6)
        profile = shapes.smoothed(
            [(0.01, 0), (r, 0), (r * 1.05, h * 0.6), (r * 0.6, h), (r * 0.7, h * 1.08)]
        )
        color = stage.hue(random, random.uniform(0.25, 0.65))
        glaze = random.choice(
            [
                materials.speckled("jar", color, stage.hue(random, 0.15), size=0.07),
                materials.plain("jar", color, 0.4),
                materials.stripes("jar", [color, stage.hue(random, 0.6)], 0.1),
            ]
        )
        shapes.place(
            shapes.turned(f"jar {x:.2f}", profile, glaze), (x + r, random.uniform(-0.18, 0.1), z)
        )
        x += 2 * r + random.uniform(0.03, 0.12)


def _cup_of_pencils(random, x, z):
    cup = [(0.01, 0), (0.11, 0), (0.12, 0.26), (0.11, 0.26), (0.1, 0.02), (0.01, 0.02)]
    shapes.place(
        shapes.turned("cup", cup, materials.mottled("cup", stage.hue(random, 0.5))), (x, -0.2, z)
    )
    for i in range(7):
        foot = (x + random.uniform(-0.06, 0.06), -0.2 + random.uniform(-0.06, 0.06), z + 0.04)
        tip = (
            foot[0] + random.uniform(-0.16, 0.16),
            foot[1] + random.uniform(-0.14, 0.1),
            z + random.uniform(0.5, 0.68),
        )
        shapes.rod(
            f"pencil {i + 1}",
            [foot, tip],
            0.013,
            materials.plain("pencil", stage.hue(random, 0.6, 1)),
        )


def _wire_basket(random, x, z):
    wire = materials.plain("wire", (0.04, 0.04, 0.045), 0.5)
    w, d, h, parts = 0.62, 0.42, 0.42, []
    for level in (0.02, h / 2, h):
        ring = [
            (-w / 2, -d / 2),
            (w / 2, -d / 2),
            (w / 2, d / 2),
            (-w / 2, d / 2),
            (-w / 2, -d / 2),
        ]
        parts.append(
            shapes.rod("ring", [(x + a, b - 0.05, z + level) for a, b in ring], 0.008, wire)
        )
    for i in range(9):
        a = x - w / 2 + w * i / 8
        for b in (-d / 2 - 0.05, d / 2 - 0.05):
            parts.append(shapes.rod("bar", [(a, b, z), (a, b, z + h)], 0.006, wire))
    bpy.context.view_layer.update()
    shapes.joined("basket", parts)
    for i in range(4):
        skin = materials.mottled("ball", stage.hue(random, 0.5, 0.8), size=0.06)
        shapes.place(
            shapes.ball(f"ball {i + 1}", 0.11, skin),
            (x - 0.18 + 0.12 * i, random.uniform(-0.12, 0.05), z + (0.17 if i % 2 else 0.01)),
        )


def _plant(random, x, z):
    pot = [(0.01, 0), (0.12, 0), (0.17, 0.24), (0.15, 0.24), (0.02, 0.2)]
    shapes.place(
        shapes.turned("pot", pot, materials.mottled("pot", (0.5, 0.22, 0.12))), (x, -0.1, z)
    )
    green = materials.mottled("blade", (0.14, 0.34, 0.1), size=0.07)
    parts = []
    for _ in range(16):
        angle, lean = random.uniform(0, 2 * math.pi), random.uniform(0.2, 0.9)
        start = (x, -0.1, z + 0.2)
        heading = (lean * math.cos(angle), lean * math.sin(angle) - 0.2, 1)
        points = stage.twig(random, start, heading, random.uniform(0.3, 0.62), wander=0.2)
        parts.append(shapes.rod("blade", points, 0.016, green, 0.004))
    bpy.context.view_layer.update()
    shapes.joined("plant", parts)


def _picture(random, x, z):
    print_ = materials.checks("picture", stage.hue(random, 0.6), stage.hue(random, 0.25), size=0.09)
    shapes.place(
        shapes.box("picture", (0.6, 0.03, 0.75), print_),
        (x, 0.0, z),
        (-15, 0, random.uniform(-20, 20)),
    )


def _strings(random):
    """Beads on strings that hang from the upper board, before everything else."""
    cord = materials.plain("cord", (0.6, 0.55, 0.4))
    for i in range(3):
        x, y = random.uniform(-1.2, 1.2), -DEPTH / 2 - random.uniform(0.1, 0.45)
        low, top = random.uniform(0.9, 1.6), FLOORS * STEP
        parts = [shapes.rod("cord", [(x, y, low), (x, y, top)], 0.008, cord)]
        bead = materials.plain("bead", stage.hue(random, 0.6, 1), 0.4)
        for _ in range(5):
            parts.append(
                shapes.place(
                    shapes.ball("bead", random.uniform(0.03, 0.06), bead, 24),
                    (x, y, random.uniform(low, top - 0.8)),
                )
            )
        bpy.context.view_layer.update()
        shapes.joined(f"string {i + 1}", parts)


def build(random):
    _carcass(random)
    bays = [(-1.5, -0.1), (0.1, 1.5)]
    floors = [0, 1, 2]
    random.shuffle(floors)
    low, middle, high = (STEP * floor for floor in floors)
    random.shuffle(bays)
    _books(random, *bays[0], low)
    _jars(random, bays[1][0] + 0.1, bays[1][1] - 0.5, low)
    _cup_of_pencils(random, random.uniform(-1.2, -0.9), middle)
    _wire_basket(random, random.uniform(-0.3, 0.2), middle)
    _plant(random, random.uniform(0.8, 1.2), middle)
    _jars(random, -1.45, -0.3, high)
    _picture(random, random.uniform(0.1, 0.4), high)
    _books(random, 0.75, 1.25, high)
    _strings(random)
    stage.lamp((-2.2, -3.2, 3.4), (0, 0, 1.4), 1.0, 190, (1, 0.95, 0.88))
    stage.sky((0.8, 0.88, 1), 0.5)
    stage.camera(
        (random.uniform(-0.5, 0.5), -4.4, random.uniform(1.5, 2.0)), (0, 0, 1.42), focal_mm=46
    )
