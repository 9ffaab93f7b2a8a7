# SPDX-License-Identifier: BSD-3-Clause
"""Packed scenes to choose and to report with, and what is measured on them."""
import io
import json
import os

import numpy as np
import torch
from PIL import Image

import kernels
import views

BORDER = 15


class Scene:
    def __init__(self, name, images, offsets, truth):
        self.name, self.images, self.offsets, self.truth = name, images, offsets, truth
        self.rival = None

    def prepared(self, dtype=torch.half, device='cuda', few=6, many=12):
        """packed, offsets, table of few, table of many; one scene a batch."""
        im = torch.tensor(self.images, device=device).permute(0, 3, 1, 2)[None].float() / 255
        off = torch.tensor(np.array(self.offsets, np.float32), device=device)[None]
        o = [tuple(p) for p in self.offsets]
        table = lambda n: torch.tensor(views.choose(o, n), device=device)[None].contiguous()
        return kernels.pack(im, dtype), off, table(few), table(many)

    def range(self, device='cuda', extra=.1, wide=0.):
        lo, hi = float(np.nanmin(self.truth)) - extra, float(np.nanmax(self.truth)) + extra
        lo, hi = lo - wide * (hi - lo) / 2, hi + wide * (hi - lo) / 2
        return torch.tensor([lo], device=device), torch.tensor([hi], device=device)


def pack(path, scenes):
    """scenes: name, V H W 3 uint8 with the reference first, offsets (V, 2), truth H W."""
    arrays, names = {}, []
    for i, (name, images, offsets, truth) in enumerate(scenes):
        files = []
        for im in images:
            f = io.BytesIO()
            Image.fromarray(im).save(f, 'WEBP', lossless=True, quality=60, method=4)
            files.append(f.getvalue())
        arrays[f'{i}_views'] = np.frombuffer(b''.join(files), np.uint8)
        arrays[f'{i}_sizes'] = np.array([len(f) for f in files])
        arrays[f'{i}_offsets'], arrays[f'{i}_truth'] = np.array(offsets, np.int16), truth.astype(np.float32)
        names.append(name)
    np.savez(path, names=np.array(json.dumps(names)), **arrays)


def unpack(path):
    z = np.load(path)
    for i, name in enumerate(json.loads(str(z['names']))):
        data, at, images = z[f'{i}_views'].tobytes(), 0, []
        for n in z[f'{i}_sizes']:
            images.append(np.asarray(Image.open(io.BytesIO(data[at:at + n])).convert('RGB')))
            at += n
        yield Scene(name, np.stack(images), [tuple(int(x) for x in o) for o in z[f'{i}_offsets']], z[f'{i}_truth'])


def read_raw(path, name):
    """A scene written flat: int32 rows, columns, H, W; uint8 views; float truth; float rival map."""
    with open(path, 'rb') as f:
        v, u, h, w = (int(n) for n in np.frombuffer(f.read(16), np.int32))
        lf = np.frombuffer(f.read(v * u * h * w * 3), np.uint8).reshape(v, u, h, w, 3)
        maps = np.frombuffer(f.read(), np.float32).reshape(-1, h, w)
    o = views.rectangle(v, u, v // 2, u // 2)
    scene = Scene(name, np.stack([lf[v // 2 + dv, u // 2 + du] for dv, du in o]), o, maps[0].copy())
    scene.rival = maps[1].copy() if len(maps) > 1 else None
    return scene


def read_all(path):
    """A packed file, or a folder of flat scenes NAME.raw with NAME.txt beside them."""
    if not os.path.isdir(path):
        return list(unpack(path))
    names = sorted(f[:-4] for f in os.listdir(path) if f.endswith('.raw'))
    return [read_raw(f'{path}/{n}.raw', open(f'{path}/{n}.txt').read().strip()) for n in names]


def errors(estimate, truth, border=BORDER):
    e = (estimate - truth)[border:-border, border:-border] if border else estimate - truth
    e = e[np.isfinite(e)]
    return np.array([100 * (e ** 2).mean()] + [100 * (np.abs(e) > t).mean() for t in (.07, .03, .01)])


MAPS = ('volume', 'selected', 'map', 'mean')


def judge(net, scenes, D=40, dtype=torch.half, autocast=True, **options):
    """name -> map -> MSE x 100, BadPix .07 .03 .01."""
    result = {}
    with torch.no_grad(), torch.autocast('cuda', torch.bfloat16, enabled=autocast):
        for scene in scenes:
            lo, hi = scene.range(wide=options.get('wide', 0.))
            labels = D if D else automatic(lo, hi)
            p, off, few, many = scene.prepared(dtype, few=options.get('few', 6), many=options.get('many', 12))
            given = torch.tensor(scene.rival, device='cuda')[None] if options.get('polish') else None
            r = net.infer(p, 0, off, few, many, lo, hi, labels, given, options.get('rounds', 1))
            r.setdefault('volume', given)
            result[scene.name] = {k: errors(r[k][0].float().cpu().numpy(), scene.truth) for k in MAPS}
            if options.get('keep') is not None:
                options['keep'][scene.name] = {k: v[0].float().cpu().numpy() for k, v in r.items()}
    return result


def automatic(lo, hi, step=.1):
    """Labels that make the step at most `step`: a multiple of 8 from 32 to 64."""
    n = int(np.ceil(float(hi - lo) / step)) + 1
    return int(min(64, max(32, (n + 7) // 8 * 8)))


def means(result):
    return {k: np.mean([r[k] for r in result.values()], 0) for k in MAPS}
