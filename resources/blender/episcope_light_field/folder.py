# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""The folder that a light field is rendered to, and its manifest `light_field.json`, which says how
the views were made and which are complete. Files are whole or absent, so that the folder can be
read at any time and rendering goes on where it was stopped."""

import json
import os

import numpy

MANIFEST = "light_field.json"
FORMAT = "episcope light field"
VERSION = 1

# What may differ when rendering goes on: it changes no pixel, or follows from what was rendered.
NOT_COMPARED = {"blender", "scene", "disparity_range", "complete"}

PART_NAMES = {
    "depth": "depth/depth_{row:02}_{column:02}.npy",
    "depth_behind": "depth_behind/depth_behind_{row:02}_{column:02}.npy",
    "labels": "labels/label_{row:02}_{column:02}.npy",
    "normals": "normals/normal_{row:02}_{column:02}.npy",
}


class FolderProblem(Exception):
    """A sentence for the user."""


def view_pattern(suffix):
    return "views/view_{row:02}_{column:02}" + suffix


def _replace(path, write):
    """Writes beside `path`, then puts it in place. The name keeps its suffix, which writers
    heed."""
    folder, name = os.path.split(path)
    temporary = os.path.join(folder, ".unfinished_" + name)
    write(temporary)
    os.replace(temporary, path)


class Folder:
    """A light field that is being rendered. `facts` is what the manifest says besides what is
    complete; a folder begun with other facts is not continued."""

    def __init__(self, path, facts):
        self.path = os.path.abspath(path)
        self.facts = {"format": FORMAT, "version": VERSION, **json.loads(json.dumps(facts))}
        self.complete = self._begun()
        try:
            for pattern in self.facts["files"].values():
                os.makedirs(os.path.dirname(os.path.join(self.path, pattern)), exist_ok=True)
            self._write_manifest()
        except OSError as error:
            raise FolderProblem(
                f"{self.path} cannot be written ({error.strerror}); choose another folder."
            ) from error

    def _begun(self):
        """Views that an earlier run has completed."""
        try:
            with open(os.path.join(self.path, MANIFEST), encoding="utf-8") as file:
                manifest = json.load(file)
        except (FileNotFoundError, NotADirectoryError):
            return []
        except (OSError, ValueError) as error:
            raise FolderProblem(
                f"{MANIFEST} in {self.path} cannot be read ({error}); choose another folder."
            ) from error
        differing = [
            key
            for key in sorted({*manifest, *self.facts} - NOT_COMPARED)
            if manifest.get(key) != self.facts.get(key)
        ]
        if differing:
            raise FolderProblem(
                f"{self.path} holds a light field of other settings ({', '.join(differing)}); "
                "choose another folder, or delete this one."
            )
        self._include(manifest.get("disparity_range"))
        complete = [tuple(view) for view in manifest.get("complete", [])]
        return [view for view in complete if self._has(view)]

    def _include(self, disparities):
        """Widens the range that the manifest promises."""
        if disparities:
            low, high = self.facts["disparity_range"]
            self.facts["disparity_range"] = [min(low, disparities[0]), max(high, disparities[1])]

    def _has(self, view):
        return all(os.path.isfile(self.file(part, view)) for part in self.facts["files"])

    def file(self, part, view):
        pattern = self.facts["files"][part]
        return os.path.join(self.path, pattern.format(row=view[0], column=view[1]))

    def save_array(self, part, view, array):
        _replace(self.file(part, view), lambda name: numpy.save(name, array))

    def save_picture(self, view, write):
        """`write` is called with the name to write to."""
        _replace(self.file("views", view), write)

    def finish(self, view, disparities):
        """All files of this view are there. `disparities`: smallest and largest; None = unknown."""
        self._include(disparities)
        self.complete.append(view)
        self._write_manifest()

    def _write_manifest(self):
        manifest = {**self.facts, "complete": [list(view) for view in self.complete]}
        text = json.dumps(manifest, indent=1)

        def write(name):
            with open(name, "w", encoding="utf-8") as file:
                file.write(text + "\n")
                file.flush()
                os.fsync(file.fileno())

        _replace(os.path.join(self.path, MANIFEST), write)
