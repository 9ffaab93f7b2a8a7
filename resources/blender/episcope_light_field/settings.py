# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""What a user chooses for the light field of a camera; kept with the camera in the .blend file."""

import bpy
from bpy.props import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

SPACING = (
    ("BASELINE", "Baseline", "Distance of neighboring cameras, in scene units"),
    ("RANGE", "Disparity range", "The distance follows from the depths that the camera sees"),
)
ZERO_PLANE = (
    ("DISTANCE", "Distance", "Depth along the optical axis, in scene units"),
    ("OBJECT", "Object", "The depth of an object's origin"),
    ("RANGE", "By the range", "The largest wanted disparity is that of the nearest depth"),
)
PICTURES = (
    ("PNG8", "PNG, 8 bit", "As shown on the screen, in 8 bit"),
    ("PNG16", "PNG, 16 bit", "As shown on the screen, in 16 bit"),
    ("EXR", "OpenEXR", "Linear in light, 32-bit floats"),
)
LABELS = (
    ("NONE", "None", "No labels"),
    ("EACH", "Each object", "Every object has a label of its own, in the order of their names"),
    ("OBJECT", "Object index", "Pass index of the object, under Object properties, Relations"),
    (
        "MATERIAL",
        "Material index",
        "Pass index of the material, under Material properties, Settings",
    ),
)


class LightFieldSettings(bpy.types.PropertyGroup):
    rows: IntProperty(name="Rows", default=9, min=1, max=99)
    columns: IntProperty(name="Columns", default=9, min=1, max=99)
    spacing: EnumProperty(name="Spacing", items=SPACING, default="RANGE")
    baseline: FloatProperty(
        name="Baseline",
        description="Distance of neighboring cameras",
        default=0.1,
        min=0,
        precision=4,
        unit="LENGTH",
    )
    disparity_min: FloatProperty(
        name="Smallest disparity", description="Of the farthest depth, in px per view", default=-1.5
    )
    disparity_max: FloatProperty(
        name="Largest disparity", description="Of the nearest depth, in px per view", default=1.5
    )
    zero_plane: EnumProperty(name="Zero plane", items=ZERO_PLANE, default="RANGE")
    zero_distance: FloatProperty(
        name="Distance",
        description="Depth at which the disparity is 0",
        default=5,
        min=0,
        unit="LENGTH",
    )
    zero_object: PointerProperty(
        name="Object", description="Disparity is 0 at its origin", type=bpy.types.Object
    )
    samples: IntProperty(name="Samples", default=64, min=1, description="Of the colors, per pixel")
    denoise: BoolProperty(
        name="Denoise",
        description="Denoising is done view by view: what is smoothed away differs between views",
    )
    seed: IntProperty(
        name="Seed", min=0, max=2**30, description="Of the noise; every view has its own"
    )
    picture: EnumProperty(name="Views", items=PICTURES, default="PNG8")
    depth: BoolProperty(name="Depth", default=True)
    normals: BoolProperty(name="Normals", description="In directions of the world")
    labels: EnumProperty(name="Labels", items=LABELS, default="EACH")
    transparent: PointerProperty(
        name="Transparent",
        description="Depth is written twice, with the objects of this collection and without",
        type=bpy.types.Collection,
    )
    folder: StringProperty(name="Folder", subtype="DIR_PATH", default="//light_field")
    shows_grid: BoolProperty(name="Show in viewport", default=True)
    near: FloatProperty(name="Nearest", unit="LENGTH", description="0 = not measured yet")
    far: FloatProperty(name="Farthest", unit="LENGTH")


def register():
    bpy.utils.register_class(LightFieldSettings)
    bpy.types.Camera.episcope = PointerProperty(type=LightFieldSettings)


def unregister():
    del bpy.types.Camera.episcope
    bpy.utils.unregister_class(LightFieldSettings)
