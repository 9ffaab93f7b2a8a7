# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""A glass pane before the analytic scene: two layers where the pane is, one elsewhere."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy
import numpy
from mathutils import Matrix

import proof
from recipes import materials, shapes

PANE_DEPTH = 4.0
PANE_SIZE = 1.5
TOLERANCE = 1e-4  # relative


def add_pane(kind):
    half = PANE_SIZE / 2
    corners = [(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)]
    pane = shapes.add("pane", corners, [(0, 1, 2, 3)], kind)
    pane.matrix_world = proof.CAMERA @ Matrix.Translation((0, 0, -PANE_DEPTH))
    collection = bpy.data.collections.new("Glass")
    bpy.context.scene.collection.children.link(collection)
    bpy.context.scene.collection.objects.unlink(pane)
    collection.objects.link(pane)
    return pane


def glass():
    """A material that refracts."""
    material = bpy.data.materials.new("glass")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    shader = nodes.new("ShaderNodeBsdfGlass")
    material.node_tree.links.new(shader.outputs["BSDF"], nodes["Material Output"].inputs["Surface"])
    return material


def prove(folder, manifest):
    for row in range(3):
        for column in range(3):
            view = (row, column)
            expected, surface = proof.exact(manifest, view)
            depth = proof.array(folder, manifest, "depth", view)
            behind = proof.array(folder, manifest, "depth_behind", view)
            labels = proof.array(folder, manifest, "labels", view)
            is_pane = ~numpy.isnan(behind)
            is_safe = proof.away_from_edges(surface) & proof.away_from_edges(is_pane)
            assert 0.05 < is_pane.mean() < 0.8, is_pane.mean()
            near = abs(depth[is_pane] - PANE_DEPTH).max() / PANE_DEPTH
            far = (abs(behind - expected) / expected)[is_pane & is_safe].max()
            single = (abs(depth - expected) / expected)[~is_pane & is_safe].max()
            print(
                f"proof: view {view}: pane {near:.1e}, behind it {far:.1e}, beside it {single:.1e}"
            )
            assert max(near, far, single) <= TOLERANCE
            number = {label["name"]: label["value"] for label in manifest["labels"]}["pane"]
            assert (labels[is_pane] == number).all() and (labels[~is_pane] != number).all()


def main():
    (work,) = proof.arguments(1)
    proof.fresh_folder(work)
    scene = proof.build_scene()
    pane = add_pane(materials.pane("print", (0.8, 0.5, 0.3)))
    options = ["--grid", "3x3", "--size", "160x120", "--range=-1,2", "--samples", "4"]
    for kind in (pane.data.materials[0], glass()):
        pane.data.materials[0] = kind
        folder = os.path.join(work, kind.name)
        prove(folder, proof.render(scene, folder, *options, "--transparent", "Glass"))
        assert pane.data.materials[0] == kind and not pane.hide_render


main()
