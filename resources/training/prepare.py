# SPDX-License-Identifier: BSD-3-Clause
"""Prepares scenes to choose and to report with.

    prepare.py demos FLAT_SCENE scenes.json choosing FOLDER [SIZE] [JOBS] [METHOD]
    prepare.py stored COTTON STILL_LIFE FILE.npz

The first writes every built-in scene of a set beside the map of a method (plane_pm; none: without; flat_scene.cpp), the second
packs the two stored scenes.
"""
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np


def demos(tool, sets, name, folder, size='256', jobs='5', method='plane_pm'):
    with open(sets) as f:
        names = [s for group in json.load(f)[name].values() for s in group if s.startswith('demo:')]
    os.makedirs(folder, exist_ok=True)

    def one(numbered):
        number, text = numbered
        path = f'{folder}/{number:02d}'
        subprocess.run([tool, text, size, path + '.part', method, '2'], check=True)
        with open(path + '.txt', 'w') as f:
            f.write(text)
        os.rename(path + '.part', path + '.raw')

    with ThreadPoolExecutor(int(jobs)) as pool:
        list(pool.map(one, enumerate(names)))
    print('scenes ready:', len(names))


def read_pfm(path):
    with open(path, 'rb') as f:
        assert f.readline().strip() == b'Pf'
        width, height = map(int, f.readline().split())
        order = '<f4' if float(f.readline()) < 0 else '>f4'
        return np.flipud(np.frombuffer(f.read(), order).reshape(height, width)).astype(np.float32)


def stored(cotton, still_life, path):
    import h5py
    from PIL import Image

    import scenes
    import views
    o = views.rectangle(9, 9, 4, 4)
    first = np.stack([np.asarray(Image.open(f'{cotton}/input_Cam{(4 + v) * 9 + 4 + u:03d}.png').convert('RGB')) for v, u in o])
    with h5py.File(f'{still_life}/lf.h5') as f:
        a, z = dict(f.attrs), f['GT_DEPTH'][4, 4]
        second = np.stack([f['LF'][4 + v, 4 + u] for v, u in o])
    d = a['dH'] * a['focalLength'] / z - a['shift']
    scenes.pack(path, [('cotton', first, o, read_pfm(f'{cotton}/gt_disp_lowres.pfm')), ('still_life', second, o, d)])


if __name__ == '__main__':
    {'demos': demos, 'stored': stored}[sys.argv[1]](*sys.argv[2:])
