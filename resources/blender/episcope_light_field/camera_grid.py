# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""The grid of cameras: where each one stands, how its lens is shifted, and what disparities follow.

All cameras look the same way. A view is shifted by its lens so that a plane parallel to the image
at the distance `zero_plane` appears at the same pixels everywhere: eq. (1) and (2) of Wanner,
Meister, Goldluecke 2013. With the depth Z along the optical axis, and b the distance of neighbors,

    d = b·f/Z − b·f/Z0    px per view step, f in px, Z0 = zero_plane.

Rows grow downwards and columns to the camera's right; a point at (x, y) in the center view appears
at (x − d·(column − center), y − d·(row − center)).
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Lens:
    """A perspective camera at a resolution. Extents are those of the image plane at distance 1."""

    width: int  # px
    height: int  # px
    extent: float  # of the image's width
    shift_unit: float  # what a lens shift of 1 moves the image plane by

    @property
    def focal_px(self):
        return self.width / self.extent


@dataclass(frozen=True)
class CameraGrid:
    rows: int
    columns: int
    baseline: float  # b, scene units
    zero_plane: float  # Z0, scene units
    lens: Lens

    @property
    def center(self):
        """The middle view; of an even count the one below or right of the middle."""
        return self.rows // 2, self.columns // 2

    def offset(self, row, column):
        """Where the camera of a view stands, from the central one: to its right, and up."""
        center_row, center_column = self.center
        return self.baseline * (column - center_column), self.baseline * (center_row - row)

    def lens_shift(self, row, column):
        """What is added to the lens shift of the camera, in Blender's unit."""
        right, up = self.offset(row, column)
        scale = -1 / (self.zero_plane * self.lens.shift_unit)
        return right * scale, up * scale

    def disparity(self, depth):
        """In px per view step."""
        return self.baseline * self.lens.focal_px * (1 / depth - 1 / self.zero_plane)

    def views_from_center(self):
        """(row, column) of every view, rings around the center one after another, so that what is
        rendered first is a light field, if a smaller one."""
        center_row, center_column = self.center

        def ring(view):
            return max(abs(view[0] - center_row), abs(view[1] - center_column))

        views = [(row, column) for row in range(self.rows) for column in range(self.columns)]
        return sorted(views, key=lambda view: (ring(view), view))


def baseline_for_range(width_px, near, far, focal_px):
    """The distance of neighbors by which the disparities of depths from `near` to `far` cover
    `width_px`."""
    return width_px / (focal_px * (1 / near - 1 / far))


def zero_plane_for_range(largest_px, near, baseline, focal_px):
    """The plane of zero disparity with which depth `near` has the disparity `largest_px`; infinite
    or negative if there is none in front of the camera."""
    inverse = 1 / near - largest_px / (baseline * focal_px)
    return float("inf") if inverse == 0 else 1 / inverse
