# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""The grid of cameras by the depths that were last measured: for panel and viewport, which are
drawn often and must not cast rays."""

from . import plan


def measure(settings, scene, camera, depsgraph):
    """Raises BadSettings."""
    settings.near, settings.far = plan.measured_range(scene, camera, depsgraph)


def grid(settings, scene, camera, depsgraph):
    """None if nothing was measured yet. Raises BadSettings."""
    if settings.near <= 0:
        return None
    seen = settings.near, settings.far
    return plan.grid_of(settings, scene, camera, seen, depsgraph)
