# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Fruit, books and twigs in a vase on a table before a wall."""

from . import materials, shapes, stage


def _table_and_wall(random):
    top = random.choice(
        [
            materials.wood("table", (0.42, 0.24, 0.12), size=0.16),
            materials.checks("cloth", stage.hue(random, 0.5), (0.75, 0.72, 0.65), size=0.3),
        ]
    )
    shapes.place(shapes.box("table", (6, 4.4, 0.1), top), (0, -0.3, -0.1))
    color = stage.hue(random, 0.55, 0.35)
    wall = random.choice(
        [
            materials.mottled("plaster", color, size=0.35, contrast=0.3),
            materials.stripes("wallpaper", [color, (0.7, 0.68, 0.6)], size=0.4, direction="X"),
        ]
    )
    shapes.place(shapes.sheet("wall", 9, 5, wall), (0, 1.9, -1.2), (0, 0, random.uniform(-6, 6)))


def _vase_with_twigs(random, x, y):
    profile = [(0.02, 0), (0.2, 0), (0.3, 0.25), (0.24, 0.55), (0.1, 0.8), (0.14, 0.95)]
    widened = [
        (r * random.uniform(0.9, 1.15) if 0 < i < 5 else r, z) for i, (r, z) in enumerate(profile)
    ]
    glaze = materials.speckled("glaze", stage.hue(random, 0.5), (0.05, 0.05, 0.07), size=0.09)
    shapes.place(shapes.turned("vase", shapes.smoothed(widened), glaze), (x, y, 0))
    bark = materials.mottled("bark", (0.2, 0.12, 0.07), size=0.06)
    leaf = materials.mottled("leaf", (0.16, 0.36, 0.1), size=0.08, contrast=0.4)
    parts = []
    for _ in range(random.randint(6, 8)):
        lean = (random.uniform(-0.55, 0.55), random.uniform(-0.45, 0.25), 1)
        points = stage.twig(random, (x, y, 0.85), lean, random.uniform(0.9, 1.4))
        parts.append(shapes.rod("twig", points, 0.022, bark, 0.009))
        for point in points[3:]:
            if random.random() < 0.5:
                bud = shapes.ball("bud", random.uniform(0.03, 0.055), leaf, steps=16)
                parts.append(shapes.place(bud, point))
    stage.bpy.context.view_layer.update()
    shapes.joined("twigs", parts)


def _bowl_of_fruit(random, x, y):
    clay = materials.stripes("bowl", [(0.5, 0.3, 0.2), (0.75, 0.6, 0.45)], size=0.12)
    profile = [
        (0.02, 0),
        (0.22, 0),
        (0.42, 0.14),
        (0.52, 0.3),
        (0.5, 0.3),
        (0.38, 0.14),
        (0.02, 0.05),
    ]
    shapes.place(shapes.turned("bowl", shapes.smoothed(profile, 4), clay), (x, y, 0))
    kinds = [((0.6, 0.1, 0.06), 0.17), ((0.75, 0.45, 0.05), 0.19), ((0.35, 0.5, 0.08), 0.16)]
    spots = [(-0.2, -0.08), (0.18, -0.12), (0.02, 0.2), (0.0, -0.02)]
    for i, (dx, dy) in enumerate(spots):
        color, radius = random.choice(kinds)
        skin = materials.mottled("fruit", color, size=0.07, contrast=0.45, roughness=0.4)
        fruit = shapes.ball(f"fruit {i + 1}", radius * random.uniform(0.9, 1.1), skin)
        shapes.place(
            fruit,
            (x + dx, y + dy, 0.15 + (0.22 if i == 3 else 0)),
            (random.uniform(0, 40), random.uniform(0, 40), 0),
        )


def _books(random, x, y):
    z = 0.0
    for i in range(random.randint(3, 4)):
        size = (random.uniform(0.7, 1.0), random.uniform(0.5, 0.65), random.uniform(0.08, 0.15))
        kind = random.choice([materials.mottled, materials.plain])
        book = shapes.box(
            f"book {i + 1}", size, kind(f"cover {i + 1}", stage.hue(random, 0.45)), 0.01
        )
        shapes.place(book, (x, y, z), (0, 0, random.uniform(-25, 25)))
        z += size[2]
    return z


def _candle(random, x, y, z):
    metal = materials.plain("brass", (0.45, 0.3, 0.1), roughness=0.5)
    wax = materials.mottled("wax", (0.75, 0.68, 0.5), size=0.1, contrast=0.15)
    foot = [
        (0.02, 0),
        (0.16, 0),
        (0.15, 0.03),
        (0.03, 0.06),
        (0.025, 0.35),
        (0.07, 0.4),
        (0.02, 0.41),
    ]
    shapes.place(shapes.turned("candlestick", foot, metal), (x, y, z))
    body = [(0.045, 0), (0.045, random.uniform(0.3, 0.5)), (0.001, 0.5)]
    shapes.place(shapes.turned("candle", body, wax), (x, y, z + 0.41))


def _leaning_board(random, x, y):
    print_ = materials.checks("board", stage.hue(random, 0.6), stage.hue(random, 0.3), size=0.14)
    board = shapes.box("board", (0.8, 0.04, 1.0), print_)
    shapes.place(board, (x, y, 0), (-random.uniform(12, 25), 0, random.uniform(20, 50)))


def _marbles(random):
    for i in range(random.randint(5, 7)):
        color = stage.hue(random, 0.6, 0.9)
        kind = random.choice([materials.plain, materials.mottled])
        marble = shapes.ball(f"marble {i + 1}", random.uniform(0.06, 0.11), kind("marble", color))
        shapes.place(marble, (random.uniform(-1.3, 1.3), random.uniform(-1.25, -0.75), 0))


def build(random):
    _table_and_wall(random)
    places = [-0.95, 0.05, 0.95]
    random.shuffle(places)
    _vase_with_twigs(random, places[0], random.uniform(0.1, 0.5))
    _bowl_of_fruit(random, places[1], random.uniform(-0.45, -0.1))
    height = _books(random, places[2], random.uniform(0.1, 0.4))
    _candle(random, places[2] + random.uniform(-0.1, 0.1), 0.3, height)
    _leaning_board(random, random.choice([-1.75, 1.75]), 0.9)
    _marbles(random)
    side = random.choice([-1, 1])
    stage.lamp((2.6 * side, -2.5, 3.6), (0, 0, 0.3), 1.2, 170, (1, 0.93, 0.84))
    stage.sky((0.75, 0.85, 1), 0.45)
    stage.camera((random.uniform(-0.4, 0.4), -4.3, 1.75), (0, 0.1, 0.5), focal_mm=48)
