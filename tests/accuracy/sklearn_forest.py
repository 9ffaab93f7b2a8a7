#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Counts the strokes that a plain random forest needs, for comparison.

The same user as in `episcope_label_accuracy --corrections`, who strokes the largest wrong region
of the center view, corrects scikit-learn's RandomForestClassifier on the same features of the
image. Needs Debian's python3-sklearn. First write the features, then count:

    episcope_label_accuracy --set choosing --size 256 --export FOLDER
    sklearn_forest.py FOLDER
"""

import argparse
import heapq
import pathlib
import statistics

import numpy as np
from scipy import ndimage
from sklearn.ensemble import RandomForestClassifier

WANTED = (0.90, 0.95, 0.98)
MOST_STROKES = 150
BRUSH_RADIUS = 4
LONGEST = 40


def ways(depth, start):
    """Cheapest ways from `start` through the middle of a region: the way to the farthest pixel."""
    height, width = depth.shape
    deepest = depth.max()
    cost = np.full(depth.shape, np.inf)
    origin = {}
    cost[start] = 0
    queue = [(0.0, start)]
    farthest = start
    while queue:
        length, at = heapq.heappop(queue)
        if length > cost[at]:
            continue
        farthest = at
        for dy, dx in ((0, 1), (0, -1), (1, 0), (-1, 0)):
            to = (at[0] + dy, at[1] + dx)
            if not (0 <= to[0] < height and 0 <= to[1] < width) or depth[to] <= 0:
                continue
            longer = length + 1 + (deepest / depth[to]) ** 2
            if longer < cost[to]:
                cost[to] = longer
                origin[to] = at
                heapq.heappush(queue, (longer, to))
    way = [farthest]
    while way[-1] in origin:
        way.append(origin[way[-1]])
    return way[::-1]


def add_correction(labels, truth, strokes):
    """Strokes the largest wrong region from its middle; false if every pixel is right."""
    largest, region = 0, None
    for label in np.unique(truth[(truth > 0) & (labels != truth)]):
        parts, count = ndimage.label((truth == label) & (labels != label))
        if count == 0:
            continue
        sizes = np.bincount(parts.ravel())[1:]
        if sizes.max() > largest:
            largest = sizes.max()
            region = parts == 1 + sizes.argmax()
    if region is None:
        return False
    depth = ndimage.distance_transform_edt(np.pad(region, 1))[1:-1, 1:-1]
    start = np.unravel_index(depth.argmax(), depth.shape)
    rows, columns = np.ogrid[: truth.shape[0], : truth.shape[1]]
    for y, x in ways(depth, tuple(int(i) for i in start))[:LONGEST]:
        dot = (rows - y) ** 2 + (columns - x) ** 2 <= BRUSH_RADIUS**2
        strokes[dot & (truth == truth[y, x])] = truth[y, x]
    return True


def count_strokes(features, truth):
    """Strokes until each wanted share of the pixels is right; None = not reached."""
    samples = features.reshape(features.shape[0], -1).T
    strokes = np.zeros_like(truth)
    labels = np.zeros_like(truth)
    counts = [None] * len(WANTED)
    for stroke in range(1, MOST_STROKES + 1):
        if not add_correction(labels, truth, strokes):
            break
        painted = strokes.ravel() > 0
        only = np.unique(strokes.ravel()[painted])
        if len(only) < 2:
            labels[:] = only[0]
            continue
        forest = RandomForestClassifier(n_estimators=100, class_weight="balanced", random_state=1)
        forest.fit(samples[painted], strokes.ravel()[painted])
        labels = forest.predict(samples).reshape(truth.shape)
        share = np.mean(labels[truth > 0] == truth[truth > 0])
        for i, wanted in enumerate(WANTED):
            if counts[i] is None and share >= wanted:
                counts[i] = stroke
        if counts[-1] is not None:
            break
    return counts


def text(count):
    return f"> {MOST_STROKES}" if count is None or count > MOST_STROKES else str(count)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="what --export wrote")
    folder = parser.parse_args().folder
    print("| scene | " + " | ".join(f"to {100 * w:.0f} %" for w in WANTED) + " |")
    print("|---|" + "---:|" * len(WANTED))
    table = []
    for scene in sorted(path.parent for path in folder.glob("*/features.npy")):
        counts = count_strokes(np.load(scene / "features.npy"), np.load(scene / "truth.npy"))
        table.append([MOST_STROKES + 1 if c is None else c for c in counts])
        print(f"| {scene.name} | " + " | ".join(map(text, counts)) + " |", flush=True)
    if table:
        medians = [statistics.median_low(column) for column in zip(*table)]
        print(f"| median of {len(table)} | " + " | ".join(map(text, medians)) + " |")


if __name__ == "__main__":
    main()
