# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Interruption, resuming, what is left of the user's scene, and sentences for bad settings."""

import contextlib
import io
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy
import numpy

import proof
from episcope_light_field import headless, labels, plan, rendering

OPTIONS = ["--grid", "3x3", "--size", "64x48", "--range=-1,1", "--samples", "1", "--labels", "each"]


class Stopped(Exception):
    pass


def given(*options):
    return headless.parser().parse_args([*OPTIONS, "--threads", "2", *options])


def sentence(scene, *options):
    """What the command line says of bad settings."""
    told = io.StringIO()
    with contextlib.redirect_stderr(told):
        code = headless.render(scene, given(*options))
    assert code == 1, f"{options} gave {code}"
    return told.getvalue()


def expect(text, part):
    assert part in text, f"expected '{part}' in '{text}'"
    print("proof: " + text.strip())


def state_of(scene):
    """Settings of the scene that rendering changes for a while."""
    owners = (scene.render, scene.render.image_settings, scene.cycles, scene.view_layers[0])
    values = [
        scene.camera.name,
        len(bpy.data.objects),
        len(bpy.data.cameras),
        len(bpy.data.materials),
        [o.pass_index for o in bpy.data.objects],
    ]
    for owner in owners:
        for item in owner.bl_rna.properties:
            value = getattr(owner, item.identifier)
            if isinstance(value, (int, float, str)):
                values.append((item.identifier, value))
    return values


def prove_resuming(scene, work):
    whole, broken = os.path.join(work, "whole"), os.path.join(work, "broken")
    proof.render(scene, whole, *OPTIONS)
    headless.apply_options(scene, given("--out", broken))
    before = state_of(scene)

    def stop(done, count, view):
        if done == 4:
            raise Stopped

    with contextlib.suppress(Stopped):
        depsgraph = bpy.context.evaluated_depsgraph_get()
        rendering.render_light_field(scene, plan.make_plan(scene, depsgraph), stop)
    assert state_of(scene) == before
    begun = proof.manifest_of(broken)["complete"]
    assert len(begun) == 4 and begun[0] == [1, 1], begun
    expect(sentence(scene, "--out", broken, "--grid", "5x5"), "other settings (grid)")
    manifest = proof.render(scene, broken, *OPTIONS)
    assert len(manifest["complete"]) == 9 and manifest["complete"][:4] == begun
    for i in range(9):
        view = divmod(i, 3)
        for part in ("depth", "labels"):
            assert numpy.array_equal(
                *(proof.array(f, manifest, part, view) for f in (whole, broken))
            )
        assert numpy.array_equal(*(proof.picture(f, manifest, view) for f in (whole, broken)))


def prove_sentences(scene, work):
    out = ["--out", os.path.join(work, "bad")]
    camera, settings = scene.camera, scene.camera.data.episcope
    expect(sentence(scene, *out, "--camera", "nobody"), "There is no object 'nobody'")
    expect(sentence(scene, *out, "--range=1,-1"), "1 … -1 px is empty")
    expect(sentence(scene, *out, "--baseline", "0"), "baseline is 0")
    expect(sentence(scene, *out, "--baseline", "1e-6", "--range=-1,500"), "No plane in front")
    expect(sentence(scene, *out, "--labels", "object"), "pass index 0")
    expect(sentence(scene, *out, "--transparent", "x"), "There is no collection 'x'")
    camera.data.type = "ORTHO"
    expect(sentence(scene, *out), "is orthographic")
    camera.data.type = "PERSP"
    scene.render.pixel_aspect_x = 2
    expect(sentence(scene, *out), "Pixels are not square")
    scene.render.pixel_aspect_x = 1
    turned = camera.matrix_world.copy()
    behind = bpy.data.objects.new("behind", None)
    scene.collection.objects.link(behind)
    behind.matrix_world = turned.copy()
    behind.location += turned.to_3x3().col[2]
    bpy.context.view_layer.update()
    expect(sentence(scene, *out, "--zero", "behind"), "'behind' of the zero plane is behind")
    most, labels.MOST_LABELS = labels.MOST_LABELS, 3
    expect(sentence(scene, *out), "4 objects, but Blender tells 3 labels apart")
    labels.MOST_LABELS = most
    file = os.path.join(work, "file")
    with open(file, "w", encoding="utf-8"):
        pass
    expect(sentence(scene, "--out", file, "--zero", "6"), "cannot be written")
    settings.folder = "//beside"
    expect(sentence(scene), "not saved yet")
    settings.folder = ""
    expect(sentence(scene), "No folder is chosen")
    for target in [o for o in scene.objects if o.type == "MESH"]:
        target.hide_viewport = target.hide_render = True
    expect(sentence(scene, *out), "sees no surface")
    scene.camera = None
    expect(sentence(scene, *out), "The scene has no camera")
    assert not os.path.exists(out[1])


def main():
    (work,) = proof.arguments(1)
    proof.fresh_folder(work)
    scene = proof.build_scene()
    prove_resuming(scene, work)
    prove_sentences(scene, work)


main()
