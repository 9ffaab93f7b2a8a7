# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""The panel in the properties of a camera."""

import textwrap

import bpy

from . import measured, plan
from .background import STATE

CHARACTERS_A_LINE = 46


def _sentence(layout, text, icon):
    lines = textwrap.wrap(text, CHARACTERS_A_LINE)
    column = layout.column(align=True)
    for i, line in enumerate(lines):
        column.label(text=line, icon=icon if i == 0 else "BLANK1")


class MeasureDepth(bpy.types.Operator):
    """Find the nearest and the farthest depth that the camera sees"""

    bl_idname = "episcope.measure_depth"
    bl_label = "Measure depth"

    def execute(self, context):
        scene = context.scene
        try:
            camera = plan.light_field_camera(scene)
            measured.measure(camera.data.episcope, scene, camera, context.evaluated_depsgraph_get())
        except plan.BadSettings as problem:
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        return {"FINISHED"}


class LightFieldPanel(bpy.types.Panel):
    bl_idname = "DATA_PT_episcope_light_field"
    bl_label = "Light field"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        return context.camera is not None

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        scene = context.scene
        if scene.camera is None or scene.camera.data != context.camera:
            _sentence(
                layout,
                "This is not the active camera of the scene, which the light field "
                "is rendered by; make it active with Ctrl+Numpad 0.",
                "INFO",
            )
            return
        settings = context.camera.episcope
        self._draw_grid(layout, settings)
        self._draw_outcome(layout, context, settings)
        self._draw_files(layout, scene, settings)
        self._draw_rendering(layout)

    def _draw_grid(self, layout, settings):
        column = layout.column(align=True)
        column.prop(settings, "rows")
        column.prop(settings, "columns")
        layout.prop(settings, "spacing")
        if settings.spacing == "BASELINE":
            layout.prop(settings, "baseline")
        is_placed_by_range = settings.zero_plane == "RANGE"
        if settings.spacing == "RANGE" or is_placed_by_range:
            column = layout.column(align=True)
            column.prop(settings, "disparity_min", text="Disparity from")
            column.prop(settings, "disparity_max", text="to")
        layout.prop(settings, "zero_plane")
        if settings.zero_plane == "DISTANCE":
            layout.prop(settings, "zero_distance")
        elif settings.zero_plane == "OBJECT":
            layout.prop(settings, "zero_object")
        layout.prop(settings, "shows_grid")

    def _draw_outcome(self, layout, context, settings):
        """What follows from the settings, before anything is rendered."""
        box = layout.box()
        box.operator(MeasureDepth.bl_idname, icon="DRIVER_DISTANCE")
        try:
            camera = plan.light_field_camera(context.scene)
            depsgraph = context.evaluated_depsgraph_get()
            grid = measured.grid(settings, context.scene, camera, depsgraph)
        except plan.BadSettings as problem:
            _sentence(box, str(problem), "ERROR")
            return
        for note in plan.notes(context.scene, camera):
            _sentence(box, note, "INFO")
        if grid is None:
            return
        smallest, largest = grid.disparity(settings.far), grid.disparity(settings.near)
        column = box.column(align=True)
        column.label(text=f"Depth {settings.near:.4g} … {settings.far:.4g}")
        column.label(text=f"Disparity {smallest:.3g} … {largest:.3g} px")
        column.label(text=f"Baseline {grid.baseline:.4g}")
        column.label(text=f"Zero plane {grid.zero_plane:.4g}")

    def _draw_files(self, layout, scene, settings):
        column = layout.column(align=True)
        column.prop(scene.render, "resolution_x", text="Resolution X")
        column.prop(scene.render, "resolution_y", text="Y")
        column = layout.column(align=True)
        column.prop(settings, "samples")
        column.prop(settings, "seed")
        layout.prop(settings, "denoise")
        layout.prop(settings, "picture")
        layout.prop(settings, "depth")
        layout.prop(settings, "normals")
        layout.prop(settings, "labels")
        layout.prop(settings, "transparent")
        layout.prop(settings, "folder")

    def _draw_rendering(self, layout):
        job = STATE.job
        if job is None:
            layout.operator("episcope.render_light_field", icon="RENDER_STILL")
            if STATE.message:
                _sentence(layout, STATE.message, "INFO")
            return
        row = layout.row()
        row.label(text=f"{job.done} of {job.count} views", icon="RENDER_ANIMATION")
        row.operator("episcope.stop_light_field", icon="CANCEL")


CLASSES = (MeasureDepth, LightFieldPanel)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)


def unregister():
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
