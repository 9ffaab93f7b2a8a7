# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Settings of the scene that are changed for a while."""


class Changes:
    """Sets attributes and takes everything back when the `with` block is left."""

    def __init__(self):
        self._undo = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        while self._undo:
            self._undo.pop()()

    def set(self, target, **values):
        """Attributes that this version of Blender does not have are passed over."""
        for name, value in values.items():
            if not hasattr(target, name):
                continue
            before = getattr(target, name)
            if before == value:
                continue
            setattr(target, name, value)
            self._undo.append(lambda name=name, before=before: setattr(target, name, before))

    def on_exit(self, action):
        self._undo.append(action)
