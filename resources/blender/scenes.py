# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Builds a scene from nothing and renders its light field:

    blender -b -P scenes.py -- still_life --out DIR
    blender -b -P scenes.py -- shelf --seed 3 --save shelf.blend    only saves it
    blender -P scenes.py -- glass                                   opens it
"""

import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import recipes
from episcope_light_field import headless, script


def parser():
    options = headless.parser()
    options.prog = "blender -b -P scenes.py --"
    options.description = "Builds a scene and renders its light field."
    options.add_argument("scene", choices=sorted(recipes.BUILDERS))
    options.add_argument(
        "--save", metavar="FILE.blend", help="save the scene, and do not render it"
    )
    return options


def main():
    script.make_available()
    given = parser().parse_args(script.arguments() or [])
    scene = recipes.build(given.scene, given.seed or 0)
    given.seed = None  # that of the noise follows from it
    if given.save:
        headless.apply_options(scene, given)
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(given.save))
    if bpy.app.background:
        script.leave(0 if given.save else headless.render(scene, given))


main()
