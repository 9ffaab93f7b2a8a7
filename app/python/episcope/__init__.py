# SPDX-License-Identifier: BSD-3-Clause
"""Densely sampled 4D light fields: open, estimate disparity, compare, label.

Arrays are [v, u, y, x, c]: v is the camera row, downwards; u the camera column, to the right.
Disparity is in pixels per view step, positive nearer than the plane of zero disparity.

    import episcope
    lf = episcope.open("scene")
    result = episcope.estimate(lf, "plane_pm")
    print(episcope.score(result, lf)["mse_100"])
"""

from ._episcope import (
    Camera,
    Error,
    InvalidInput,
    IoError,
    Labeling,
    LightField,
    Result,
    Unavailable,
    __version__,
    decode,
    demo,
    epi,
    estimate,
    label,
    methods,
    open,
    score,
)

__all__ = [name for name in dir() if not name.startswith("_")]
