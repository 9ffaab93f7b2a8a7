# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Entry point for Blender's command line."""

import os
import sys

import bpy

from . import headless, register


def arguments():
    """What comes after "--"; None without it."""
    return sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else None


def make_available():
    """Registers the add-on, unless it is enabled in the preferences."""
    if not hasattr(bpy.types.Camera, "episcope"):
        register()


def leave(code):
    """Ends Blender, which ignores the code of sys.exit in scripts given by -P."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)


def main():
    make_available()
    given = arguments()
    if bpy.app.background or given:
        leave(headless.run(given or []))
