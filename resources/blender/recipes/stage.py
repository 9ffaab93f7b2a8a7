# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""What every scene needs: an empty file, a camera, light and settings of the renderer."""

import math

import bpy
from mathutils import Vector


def clear():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x = scene.render.resolution_y = 512
    scene.cycles.max_bounces = 2
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.caustics_reflective = scene.cycles.caustics_refractive = False
    scene.view_settings.view_transform = "Standard"
    return scene


def camera(place, target, focal_mm=50):
    data = bpy.data.cameras.new("Camera")
    data.lens = focal_mm
    data.clip_start = 0.05
    viewer = bpy.data.objects.new("Camera", data)
    viewer.location = place
    viewer.rotation_euler = (Vector(target) - Vector(place)).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(viewer)
    bpy.context.scene.camera = viewer
    bpy.context.view_layer.update()
    return viewer


def lamp(place, target, size, power, color=(1, 1, 1)):
    """A square that shines towards `target`."""
    light = bpy.data.lights.new("Lamp", "AREA")
    light.size, light.energy, light.color = size, power, color
    source = bpy.data.objects.new("Lamp", light)
    source.location = place
    source.rotation_euler = (Vector(target) - Vector(place)).to_track_quat("-Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(source)


def sky(color, strength):
    world = bpy.data.worlds.new("World")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*color, 1)
    background.inputs["Strength"].default_value = strength
    bpy.context.scene.world = world


def twig(random, start, direction, length, steps=8, wander=0.12):
    """Points of a bent line."""
    heading = Vector(direction).normalized()
    points = [Vector(start)]
    for _ in range(steps):
        heading += Vector([random.uniform(-wander, wander) for _ in range(3)])
        heading.normalize()
        points.append(points[-1] + heading * (length / steps))
    return points


def hue(random, value=0.5, saturation=0.6):
    """A color of any hue; linear."""
    angle = random.uniform(0, 2 * math.pi)
    return tuple(
        value * (1 - saturation / 2 + saturation / 2 * math.cos(angle + k * 2 * math.pi / 3))
        for k in range(3)
    )
