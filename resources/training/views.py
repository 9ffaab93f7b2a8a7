# SPDX-License-Identifier: BSD-3-Clause
"""Sectors of views, the views that are used of each, and grids to train with."""
import math

import numpy as np

SECTORS = 8


def sector(dv, du):
    """The sector of the view at offset (dv, du): 0 to the right, 2 downwards, in steps of 45 degrees."""
    return int(math.floor((math.atan2(dv, du) + math.pi / 8) / (math.pi / 4))) % SECTORS


def choose(offsets, cap):
    """table[8][cap]: indices into `offsets` of at most `cap` views a sector, -1 where there are fewer.

    The views of a sector are sorted by (radius squared, dv, du); of n > cap views those at the
    places floor((i + 1/2) n / cap) are taken, so that they are spread over the radius.
    """
    groups = [[] for _ in range(SECTORS)]
    for i, (dv, du) in enumerate(offsets):
        if dv or du:
            groups[sector(dv, du)].append((dv * dv + du * du, dv, du, i))
    table = np.full((SECTORS, cap), -1, np.int32)
    for k, group in enumerate(groups):
        group = [g[3] for g in sorted(group)]
        n = len(group)
        if n > cap:
            group = [group[int((i + .5) * n / cap)] for i in range(cap)]
        table[k, :len(group)] = group
    return table


def rectangle(rows, columns, row, column):
    """Offsets (dv, du) of a grid of views from the view at (row, column), the reference first."""
    grid = [(v - row, u - column) for v in range(rows) for u in range(columns)]
    return [(0, 0)] + [o for o in grid if o != (0, 0)]


def draw_grid(rng):
    """A random grid: nearly half 9x9 from its centre, else other sizes, corners, lines, crosses, gaps."""
    t = rng.random()
    if t < .47:
        return rectangle(9, 9, 4, 4)
    if t < .53:
        return rectangle(9, 9, 8 * int(rng.integers(2)), 8 * int(rng.integers(2)))
    if t < .62:
        return rectangle(9, 9, int(rng.integers(9)), int(rng.integers(9)))
    if t < .70:
        return rectangle(5, 5, 2, 2)
    if t < .73:
        return rectangle(5, 5, int(rng.integers(5)), int(rng.integers(5)))
    if t < .78:
        return rectangle(3, 3, 1, 1)
    if t < .81:
        return rectangle(7, 7, 3, 3)
    if t < .85:
        return rectangle(17, 17, 8, 8)
    if t < .90:
        n = int(rng.choice([5, 9, 9, 17]))
        at = n // 2 if rng.random() < .6 else int(rng.integers(n))
        return rectangle(1, n, 0, at) if rng.random() < .5 else rectangle(n, 1, at, 0)
    if t < .94:
        return [o for o in rectangle(9, 9, 4, 4) if o[0] == 0 or o[1] == 0]
    keep = rng.uniform(.3, .9)
    return [o for o in rectangle(9, 9, 4, 4) if o == (0, 0) or rng.random() < keep]
