# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Renders in another process, so that the window stays free and the open file as it is."""

import json
import os
import subprocess
import tempfile

import bpy

from . import plan
from .folder import MANIFEST

SECONDS_BETWEEN_LOOKS = 0.5


class _Job:
    def __init__(self, camera, folder, count):
        self.folder, self.count, self.done, self.message = folder, count, 0, ""
        self._files = tempfile.TemporaryDirectory(prefix="light_field_")
        scene = os.path.join(self._files.name, "scene.blend")
        bpy.ops.wm.save_as_mainfile(filepath=scene, copy=True, check_existing=False)
        self._log_path = os.path.join(self._files.name, "log.txt")
        parent = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
        program = (
            f"import sys; sys.path.insert(0, {parent!r}); "
            "from episcope_light_field import script; script.main()"
        )
        with open(self._log_path, "w", encoding="utf-8") as log:
            self._process = subprocess.Popen(
                [bpy.app.binary_path, "-b", scene, "--python-expr", program, "--",
                 "--camera", camera.name, "--out", folder],
                stdout=log, stderr=subprocess.STDOUT,
            )  # fmt: skip

    def look(self):
        """Whether it is still running. Updates `done`, and `message` at the end."""
        code = self._process.poll()
        try:
            with open(os.path.join(self.folder, MANIFEST), encoding="utf-8") as file:
                self.done = len(json.load(file)["complete"])
        except (OSError, ValueError, KeyError):
            self.done = 0  # not begun yet
        if code is None:
            return True
        self.message = f"Complete: {self.folder}" if code == 0 else self._last_word()
        self._files.cleanup()
        return False

    def _last_word(self):
        with open(self._log_path, encoding="utf-8", errors="replace") as log:
            told = [
                line[len("light field: ") :].strip()
                for line in log
                if line.startswith("light field: ")
            ]
        return told[-1] if told else "Blender ended without a word"

    def stop(self):
        self._process.terminate()
        self._process.wait()
        self._files.cleanup()
        self.message = f"Stopped after {self.done} of {self.count} views; Render goes on."


class _State:
    job = None  # _Job while one is running
    message = ""


STATE = _State()


def _redraw(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "PROPERTIES":
                area.tag_redraw()


class RenderLightField(bpy.types.Operator):
    """Render the views that are missing in the folder"""

    bl_idname = "episcope.render_light_field"
    bl_label = "Render light field"

    _timer = None

    @classmethod
    def poll(cls, context):
        return STATE.job is None and context.scene.camera is not None

    def execute(self, context):
        try:
            chosen = plan.make_plan(context.scene, context.evaluated_depsgraph_get())
        except plan.BadSettings as problem:
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        settings = chosen.camera.data.episcope
        settings.near, settings.far = chosen.near, chosen.far
        count = chosen.grid.rows * chosen.grid.columns
        STATE.job, STATE.message = _Job(chosen.camera, chosen.folder, count), ""
        manager = context.window_manager
        self._timer = manager.event_timer_add(SECONDS_BETWEEN_LOOKS, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        _redraw(context)
        if STATE.job is not None and STATE.job.look():
            return {"PASS_THROUGH"}
        if STATE.job is not None:
            STATE.message, STATE.job = STATE.job.message, None
        context.window_manager.event_timer_remove(self._timer)
        self.report({"INFO"}, STATE.message)
        return {"FINISHED"}


class StopLightField(bpy.types.Operator):
    """Stop rendering; what is complete stays, and Render goes on from there"""

    bl_idname = "episcope.stop_light_field"
    bl_label = "Stop"

    @classmethod
    def poll(cls, context):
        return STATE.job is not None

    def execute(self, context):
        STATE.job.stop()
        STATE.message, STATE.job = STATE.job.message, None
        _redraw(context)
        return {"FINISHED"}


CLASSES = (RenderLightField, StopLightField)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)


def unregister():
    if STATE.job is not None:
        STATE.job.stop()
        STATE.job = None
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
