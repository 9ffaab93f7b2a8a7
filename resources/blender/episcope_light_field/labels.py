# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""What the labels of a light field stand for."""

import bpy

MOST_LABELS = 32767  # Blender's largest pass index
LABELLED_TYPES = {"MESH", "CURVE", "CURVES", "META", "SURFACE", "FONT", "POINTCLOUD", "VOLUME"}


def labelled_objects(scene):
    """Objects that are rendered, by their names."""
    shown = (o for o in scene.objects if o.type in LABELLED_TYPES and not o.hide_render)
    return sorted(shown, key=lambda o: o.name)


def problem(kind, scene):
    """A sentence on why labels of this kind cannot be rendered; None if they can."""
    shown = labelled_objects(scene)
    if kind == "EACH" and len(shown) > MOST_LABELS:
        return (
            f"The scene has {len(shown)} objects, but Blender tells {MOST_LABELS} labels apart; "
            "choose labels by object or material index."
        )
    if kind == "OBJECT" and not any(o.pass_index for o in shown):
        return (
            "Every object has the pass index 0, so that all labels would be 0; set Pass Index "
            "under Object properties, Relations, or choose another kind of labels."
        )
    used = [s.material for o in shown for s in o.material_slots if s.material]
    if kind == "MATERIAL" and not any(material.pass_index for material in used):
        return (
            "Every material has the pass index 0, so that all labels would be 0; set Pass Index "
            "under Material properties, Settings, or choose another kind of labels."
        )
    return None


def number_objects(changes, scene):
    """Gives every object a pass index of its own, as long as `changes` last."""
    for number, target in enumerate(labelled_objects(scene), start=1):
        changes.set(target, pass_index=number)


def names(kind, scene):
    """Names by pass index: [{"value": 1, "name": "cup, saucer"}, …]."""
    named = {}
    things = (
        [m for m in bpy.data.materials if m.users]
        if kind == "MATERIAL"
        else labelled_objects(scene)
    )
    for thing in things:
        if thing.pass_index > 0:
            named.setdefault(thing.pass_index, []).append(thing.name)
    return [{"value": value, "name": ", ".join(named[value])} for value in sorted(named)]
