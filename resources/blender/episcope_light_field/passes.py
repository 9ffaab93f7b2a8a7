# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Exact depth, labels and normals at the centers of the pixels: a render of one sample with a
filter of 0.01 px. The Z pass of Cycles is the depth along the optical axis."""

import os

import bpy
import numpy

from . import exr
from .changes import Changes

NOTHING = 1e9  # Cycles writes 1e10 where no surface is seen
SAME_DEPTH = 1e-6


def _settings_of_truth(changes, scene):
    scene_cycles = scene.cycles
    changes.set(scene.render, engine="CYCLES", film_transparent=False)
    changes.set(
        scene_cycles,
        samples=1,
        pixel_filter_type="GAUSSIAN",
        filter_width=0.01,
        use_adaptive_sampling=False,
        use_denoising=False,
        max_bounces=0,
        seed=0,
    )
    changes.set(
        scene.render.image_settings,
        file_format="OPEN_EXR_MULTILAYER",
        color_depth="32",
        exr_codec="NONE",
    )


class RenderProblem(Exception):
    """A sentence for the user."""


def render_still(scene):
    """Renders to the path of the scene. Raises RenderProblem, or KeyboardInterrupt if it was
    stopped."""
    try:
        outcome = bpy.ops.render.render(write_still=True, scene=scene.name)
    except RuntimeError as error:
        reason = str(error).strip().replace("Error: ", "")
        hint = "; turn Denoise off" if "Denoise" in reason else ""
        raise RenderProblem(f"Blender cannot render this scene: {reason}{hint}.") from error
    # Blender ends a render that was interrupted like any other, but without a file.
    if outcome != {"FINISHED"} or not os.path.exists(scene.render.filepath):
        raise KeyboardInterrupt


def _render(scene, path):
    with Changes() as changes:
        _settings_of_truth(changes, scene)
        changes.set(scene.render, filepath=path)
        render_still(scene)
    passes = exr.read_passes(path)
    os.remove(path)
    return passes


def _depth(passes):
    depth = passes["Depth.Z"]
    depth[~(depth < NOTHING)] = numpy.nan
    return depth


def _opaque_copy(material):
    """Reveals the surface of a transparent material to the depth pass."""
    opaque = bpy.data.materials.new("opaque for depth")
    opaque.use_nodes = False
    if material is not None:
        opaque.pass_index = material.pass_index
    return opaque


def _make_opaque(changes, objects):
    for target in objects:
        for slot in target.material_slots:
            opaque = _opaque_copy(slot.material)
            changes.on_exit(lambda opaque=opaque: bpy.data.materials.remove(opaque))
            changes.set(slot, material=opaque)


def render_truth(scene, transparent, temporary):
    """Arrays by part: `depth`, `labels`, `normals`, `depth_behind`. Depth is NaN where no surface
    is seen; `depth_behind` is NaN where no transparent object is in front, and infinite where
    nothing is behind one. `temporary`: a file name ending in .exr."""
    with Changes() as changes:
        _make_opaque(changes, transparent)
        passes = _render(scene, temporary)
    depth = _depth(passes)
    truth = {"depth": depth}
    label = passes.get("IndexOB.X", passes.get("IndexMA.X"))
    if label is not None:
        truth["labels"] = numpy.rint(label).astype(numpy.uint16)
    if "Normal.X" in passes:
        normals = numpy.stack([passes["Normal." + axis] for axis in "XYZ"], axis=-1)
        truth["normals"] = normals
    if transparent:
        with Changes() as changes:
            for target in transparent:
                changes.set(target, hide_render=True)
            behind = _depth(_render(scene, temporary))
        is_covered = ~(numpy.abs(behind - depth) <= SAME_DEPTH * depth) & numpy.isfinite(depth)
        behind[numpy.isnan(behind)] = numpy.inf
        truth["depth_behind"] = numpy.where(is_covered, behind, numpy.float32(numpy.nan))
    return truth
