# SPDX-License-Identifier: BSD-3-Clause
"""Draws a sheet of scenes and times the parts: check.py OUT."""
import sys
import time

import numpy as np
import torch
from PIL import Image

import generator
import kernels
import network
import views


def reference(packed, labels, table, offsets):
    """The evidence in plain PyTorch, for one scene and planes: 16 D H W."""
    _, V, H, W, _ = packed.shape
    im, t = packed[0].double(), table[0].tolist()
    ys, xs = torch.meshgrid(torch.arange(H, device=im.device), torch.arange(W, device=im.device), indexing='ij')
    out = []
    for l in labels[0].tolist():
        sums = []
        for k in range(8):
            n, a, b = 0., 0., 0.
            for v in t[k]:
                if v < 0:
                    break
                fy, fx = ys - l * float(offsets[0, v, 0]), xs - l * float(offsets[0, v, 1])
                ok = (fx >= 0) & (fx <= W - 1) & (fy >= 0) & (fy <= H - 1)
                x0, y0 = fx.floor().clamp(0, W - 1).long(), fy.floor().clamp(0, H - 1).long()
                x1, y1, ax, ay = (x0 + 1).clamp(max=W - 1), (y0 + 1).clamp(max=H - 1), (fx - x0)[..., None], (fy - y0)[..., None]
                s = im[v, y0, x0] * (1 - ay) * (1 - ax) + im[v, y0, x1] * (1 - ay) * ax + im[v, y1, x0] * ay * (1 - ax) + im[v, y1, x1] * ay * ax
                e = (s - im[0]).abs() * ok[..., None]
                n, a, b = n + ok.double(), a + e[..., :3].sum(-1), b + e[..., 3:5].sum(-1)
            none = torch.full((H, W), 1.5, device=im.device, dtype=torch.double)
            f = lambda s, c: torch.where(n > 0, (torch.log(s / n.clamp(min=1) / c + .003) + 4.2) * .8, none) if torch.is_tensor(n) else none
            sums.append((f(a, 3), f(b, 2)))
        out.append(torch.stack([s[0] for s in sums] + [s[1] for s in sums]))
    return torch.stack(out, 1)


def main():
    out = sys.argv[1]
    torch.backends.cudnn.benchmark = True
    torch.backends.cuda.matmul.allow_tf32 = torch.backends.cudnn.allow_tf32 = True
    t0 = time.time()
    g = generator.Generator(5)
    torch.cuda.synchronize()
    print('generator made after %.1f s' % (time.time() - t0))
    p, d, off, few, many = g.batch(24, S=128, margin=0)
    print('views', off.shape, 'truth', d.min().item(), d.max().item(), 'finite', bool(torch.isfinite(p).all()), (d < -100).sum().item())
    im = (p[:, 0, :, :, :3].float().clamp(0, 1) * 255).byte().cpu().numpy()
    lo, hi = d.flatten(1).min(1).values[:, None, None], d.flatten(1).max(1).values[:, None, None]
    dd = ((d - lo) / (hi - lo) * 255).byte().cpu().numpy()
    rows = [np.concatenate([np.concatenate([im[i], np.repeat(dd[i][..., None], 3, 2)], 0) for i in range(r, r + 8)], 1) for r in (0, 8, 16)]
    Image.fromarray(np.concatenate(rows, 0)).save(f'{out}/sheet.png')
    # The error of the evidence against the formula, in double.
    lab = torch.linspace(-1, 1, 5, device='cuda')[None]
    one = lambda t: t[1:2].contiguous()
    a = kernels.evidence(one(p).float(), lab, one(many), one(off), 0, False)[0]
    print('evidence differs by at most', (a - reference(one(p), lab, one(many), one(off))).abs().max().item())
    # At the truth, evidence is lowest.
    for s in (-.3, -.1, 0, .1, .3):
        print('shift %.1f' % s, kernels.evidence(p, (d + s)[:, None], many, off, 0, False)[:, :, 0].mean().item())

    def clock(name, f, n=10):
        for _ in range(3):
            f()
        torch.cuda.synchronize()
        t = time.time()
        for _ in range(n):
            f()
        torch.cuda.synchronize()
        print('%-40s %.2f ms' % (name, (time.time() - t) / n * 1e3), flush=True)

    clock('batch of 10', lambda: g.batch(10, margin=12), 24)
    k = g.batch(10, margin=12)
    clock('turned', lambda: generator.turned(*k))
    # Turning the scene, its offsets and its tables turns the evidence.
    for _ in range(6):
        q = generator.turned(*k)
        e = [kernels.evidence(p_, (t + .1)[:, None], m, o, 12, False)[:, :8].mean((1, 2)) for p_, t, o, f, m in (k, q)]
        print('mean evidence, turned', e[0].mean().item(), e[1].mean().item())
    p, d, off, few, many = g.batch(10, margin=12)
    layers = g.scene(10, 108, torch.full((10,), 4., device='cuda'))
    clock('  scene', lambda: g.scene(10, 108, torch.full((10,), 4., device='cuda')))
    clock('  draw', lambda: kernels.draw(layers, g.textures, off, torch.ones(10, off.shape[1], device='cuda'), torch.full((10,), off.shape[1], device='cuda', dtype=torch.int32), 120, 120, 3, 1))
    clock('  truth', lambda: kernels.truth(layers, 96, 96, 7).median(-1))
    lab = torch.linspace(-2, 2, 40, device='cuda')[None].repeat(10, 1)
    clock('evidence 40, few', lambda: kernels.evidence(p, lab, few, off, 12, True))
    h = torch.stack([d + i * .1 for i in range(5)], 1)
    clock('evidence 5, many', lambda: kernels.evidence(p, h, many, off, 12, False))
    net = network.channels_last(network.Net().cuda())
    image = network.guide(p, 12)
    with torch.autocast('cuda', torch.bfloat16):
        e = kernels.evidence(p, lab, few, off, 12, True)

        def both():
            net.volume(e, image).mean().backward()
        clock('volume, forward and back', both)
        with torch.no_grad():
            clock('volume, forward', lambda: net.volume(e, image))
            lg = net.volume(e, image)
            clock('modes', lambda: network.modes(lg, lab))
            clock('hypotheses', lambda: net.selection.hypotheses(d, d))
        hh = net.selection.hypotheses(d, d)
        known = torch.ones(10, device='cuda')
        clock('selection, forward and back', lambda: net.select(p, 12, off, few, image, d, d, None, None, known)[1].mean().backward())
        clock('refinement, forward and back', lambda: net.refine(p, 12, off, many, image, d, d * 0, 0)[0].mean().backward())
        w = torch.randn(10, 8, 96, 96, device='cuda').softmax(1)
        clock('decide', lambda: network.decide(hh, w))


if __name__ == '__main__':
    main()
