# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Light fields with exact depth and labels from Blender, for Episcope and readers of its files."""

bl_info = {
    "name": "Episcope light field",
    "author": "The Episcope authors",
    "version": (1, 0, 0),
    "blender": (2, 93, 0),
    "location": "Properties > Camera > Light field",
    "description": "Renders 4D light fields with exact depth and labels of every view",
    "category": "Render",
}

from . import background, overlay, panel, settings

MODULES = (settings, background, panel, overlay)


def register():
    for module in MODULES:
        module.register()


def unregister():
    for module in reversed(MODULES):
        module.unregister()
