# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Runs the add-on in the folder beside this file.

    blender -b SCENE.blend -P episcope_light_field.py -- --out DIR --grid 9x9 …    renders
    blender SCENE.blend -P episcope_light_field.py                                 shows the panel
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from episcope_light_field import script  # the package, which comes before this file

script.main()
