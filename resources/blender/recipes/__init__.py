# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Scenes built from nothing, for whoever has none to render."""

import random

from . import glass, shelf, stage, still_life

BUILDERS = {"still_life": still_life.build, "shelf": shelf.build, "glass": glass.build}


def build(name, seed):
    """Replaces the open file. The same name and seed give the same scene."""
    scene = stage.clear()
    BUILDERS[name](random.Random(f"{name} {seed}"))
    settings = scene.camera.data.episcope
    settings.disparity_min, settings.disparity_max = -1.5, 1.8
    settings.samples = 32
    settings.seed = 1000 * seed
    return scene
