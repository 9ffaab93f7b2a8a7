# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Runs the add-on in the folder beside this file.

    blender -b SCENE.blend -P episcope_light_field.py -- --out DIR --grid 9x9 …    renders
    blender SCENE.blend -P episcope_light_field.py                                 shows the panel
"""

import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.modules.pop("episcope_light_field", None)

import episcope_light_field  # the package, which comes before this file
from episcope_light_field import headless


def main():
    if not hasattr(bpy.types.Camera, "episcope"):
        episcope_light_field.register()
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else None
    if bpy.app.background or arguments:
        code = headless.run(arguments or [])
        sys.stdout.flush()
        os._exit(code)  # Blender ignores the code of sys.exit in scripts given by -P


main()
