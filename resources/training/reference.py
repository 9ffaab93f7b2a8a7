# SPDX-License-Identifier: BSD-3-Clause
"""The whole inference in NumPy, for readers: reference.py net.npz net_vectors.npz compares.

Slow, and meant to be: every formula that the engine needs is here once, without PyTorch.
"""
import json
import sys

import numpy as np

import views


class Weights:
    def __init__(self, path):
        self.z = {k: v for k, v in np.load(path).items()}
        self.record = json.loads(self.z['record'].tobytes())
        self.layers = self.record['architecture']['layers']


def leaky(x):
    return np.where(x > 0, x, x * np.float32(.1))


def conv(w, name, x):
    """x: C (D) H W, zeros outside; kernel k, stride, dilation as the record says."""
    l = w.layers[name]
    weight = w.z[name + '.weight'].astype(np.float32)
    if name + '.scale' in w.z:
        weight *= w.z[name + '.scale'].astype(np.float32).reshape(-1, *[1] * (weight.ndim - 1))
    n, k, s, r = l['dimensions'], l['kernel'], l['stride'], l['dilation']
    pad = r * (k // 2)
    xp = np.pad(x, [(0, 0)] + [(pad, pad)] * n)
    size = [(d - 1) // s + 1 for d in x.shape[1:]]
    out = np.zeros((weight.shape[0], *size), np.float32)
    for tap in np.ndindex(*[k] * n):
        window = xp[(slice(None), *[slice(t * r, t * r + (m - 1) * s + 1, s) for t, m in zip(tap, size)])]
        out += np.tensordot(weight[(slice(None), slice(None), *tap)], window, 1)
    if l['bias']:
        out += w.z[name + '.bias'].astype(np.float32).reshape(-1, *[1] * n)
    return leaky(out) if l['activation'] else out


def chain(w, x, *names):
    for name in names:
        x = conv(w, name, x)
    return x


def residual(w, name, x):
    return x + chain(w, x, name + '.0', name + '.1')


def up(x, like):
    """Twice as large along every axis but the first, linear, then cut to the shape of `like`."""
    for axis in range(1, x.ndim):
        n = x.shape[axis]
        before = np.take(x, np.maximum(np.arange(n) - 1, 0), axis)
        after = np.take(x, np.minimum(np.arange(n) + 1, n - 1), axis)
        pair = np.stack((x * np.float32(.75) + before * np.float32(.25), x * np.float32(.75) + after * np.float32(.25)), axis + 1)
        x = pair.reshape(*x.shape[:axis], 2 * n, *x.shape[axis + 1:])
    return x[(slice(None), *[slice(0, m) for m in like.shape[1:]])]


def five(image):
    """H W 3 in [0, 1] -> 5 H W: colour and the differences of grey.

    Nothing is masked here; the engine replaces a masked neighbor by the pixel itself.
    """
    g = image.mean(2)
    gx = np.pad(g, ((0, 0), (1, 1)), 'edge')
    gy = np.pad(g, ((1, 1), (0, 0)), 'edge')
    return np.stack((*image.transpose(2, 0, 1), gx[:, 2:] - gx[:, :-2], gy[2:] - gy[:-2])).astype(np.float32)


def evidence(fives, offsets, table, d):
    """16 N H W at disparities d, N H W. fives[0] is the reference view."""
    N, H, W = d.shape
    ys, xs = np.mgrid[0:H, 0:W].astype(np.float32)
    out = np.empty((16, N, H, W), np.float32)
    for k in range(8):
        rgb, gradient, n = (np.zeros((N, H, W), np.float32) for _ in range(3))
        for v in table[k]:
            if v < 0:
                break
            fy, fx = ys - d * np.float32(offsets[v][0]), xs - d * np.float32(offsets[v][1])
            seen = (fx >= 0) & (fx <= W - 1) & (fy >= 0) & (fy <= H - 1)
            fy, fx = np.clip(fy, 0, H - 1), np.clip(fx, 0, W - 1)
            y0, x0 = fy.astype(int), fx.astype(int)
            y1, x1, ay, ax = np.minimum(y0 + 1, H - 1), np.minimum(x0 + 1, W - 1), fy - y0, fx - x0
            f = fives[v]
            s = (f[:, y0, x0] * (1 - ax) + f[:, y0, x1] * ax) * (1 - ay) + (f[:, y1, x0] * (1 - ax) + f[:, y1, x1] * ax) * ay
            e = np.abs(s - fives[0][:, None]) * seen
            rgb, gradient, n = rgb + e[:3].sum(0), gradient + e[3:].sum(0), n + seen
        m = np.maximum(n, 1)
        out[k] = np.where(n > 0, (np.log(rgb / m / 3 + .003) + 4.2) * .8, 1.5)
        out[8 + k] = np.where(n > 0, (np.log(gradient / m / 2 + .003) + 4.2) * .8, 1.5)
    return out


def volume(w, e, image):
    """Logits D H W from evidence 16 D H W and the guide 5 H W."""
    p = 'volume.'
    x0 = leaky(conv(w, p + 'input', e) + chain(w, image, p + 'image.0', p + 'image.1', p + 'image.2')[:, None])
    x0 = x0 + conv(w, p + 'e0', x0)
    x1 = chain(w, x0, p + 'd1', p + 'e1')
    x2 = residual(w, p + 'r2', chain(w, x1, p + 'd2', p + 'e2.0', p + 'e2.1'))
    x3 = residual(w, p + 'r3', chain(w, x2, p + 'd3', p + 'e3.0', p + 'e3.1'))
    y2 = residual(w, p + 's2', conv(w, p + 'f2', up(conv(w, p + 'u2', x3), x2) + x2))
    y1 = conv(w, p + 'f1', up(conv(w, p + 'u1', y2), x1) + x1)
    y0 = conv(w, p + 'f0', up(conv(w, p + 'u0', y1), x0) + x0)
    return conv(w, p + 'head', y0)[0]


def modes(logits, lo, step):
    """Disparity of the highest mode and of the second, log probabilities."""
    m = logits.max(0)
    logp = logits - m - np.log(np.exp(logits - m).sum(0))
    p, D = np.exp(logp), len(logits)
    index = np.arange(D)[:, None, None]

    def peak(at):
        near = np.abs(index - at) <= 2
        q = p * near
        return lo + (q * index).sum(0) / q.sum(0) * step

    first = p.argmax(0)
    second = np.where(np.abs(index - first) <= 3, -1, p).argmax(0)
    return peak(first).astype(np.float32), peak(second).astype(np.float32), logp


def window(d, size, f, dilation=1):
    """f over the size x size window; outside, max and min see nothing and the median repeats the border."""
    n = size // 2 * dilation
    x = np.pad(d, n, 'edge')
    H, W = d.shape
    return f(np.stack([x[i * dilation:i * dilation + H, j * dilation:j * dilation + W]
                       for i in range(size) for j in range(size)]), 0)


def hypotheses(d, second):
    m = window(d, 5, np.median)
    return np.stack((d, window(d, 5, np.max), window(d, 5, np.min), m, window(m, 9, np.max), window(m, 9, np.min),
                     window(d, 5, np.median, 3), second))


def squash(t):
    return np.sign(t) * np.log1p(np.abs(t) / .05) * .4


def selection(w, e, image, h, logp, known):
    """Logits 8 H W; e: 16 8 H W; logp: 8 H W or zeros where there is no volume."""
    p = 'selection.'
    small = np.concatenate([chain(w, e[:, i], p + 'reduce.a', p + 'reduce.b') for i in range(len(h))])
    flag = np.full((1, *h.shape[1:]), known, np.float32)
    x = np.concatenate((small, np.clip(logp, -12, 0) / 4, squash(h[1:] - h[:1]), flag, image)).astype(np.float32)
    x0 = residual(w, p + 'r0', chain(w, x, p + 'i.0', p + 'i.1'))
    x1 = residual(w, p + 'r1', chain(w, x0, p + 'd1.0', p + 'd1.1'))
    x2 = chain(w, x1, p + 'd2.0', p + 'd2.1', p + 'd2.2', p + 'd2.3')
    x2 = x2 + up(chain(w, x2, p + 'd3.0', p + 'd3.1', p + 'd3.2', p + 'u2'), x2)
    y1 = residual(w, p + 's1', conv(w, p + 'f1', up(conv(w, p + 'u1', x2), x1) + x1))
    y0 = conv(w, p + 'f0', up(conv(w, p + 'u0', y1), x0) + x0)
    return conv(w, p + 'head', y0)


def decide(h, logits):
    """Mode, its probability, second hypothesis, its probability."""
    q = np.exp(logits - logits.max(0))
    q = q / q.sum(0)
    score = (np.exp(-((h[:, None] - h[None]) / .1) ** 2) * q[None]).sum(1)
    best = score.argmax(0)[None]
    own = np.take_along_axis(h, best, 0)
    k = q * np.exp(-((h - own) / .1) ** 2)
    mode = (k * h).sum(0) / np.maximum(k.sum(0), 1e-9)
    far = np.where(np.abs(h - own) < .3, -1, score)
    other = far.argmax(0)[None]
    p2 = np.take_along_axis(far, other, 0)[0]
    second = np.where(p2 > 0, np.take_along_axis(h, other, 0)[0], mode)
    return mode.astype(np.float32), np.minimum(np.take_along_axis(score, best, 0)[0], 1), second, np.clip(p2, 0, 1)


def refinement(w, number, fives, offsets, table, image, d, certainty):
    """The refined d and the confidence."""
    p, step = f'refinement.{number}.', np.float32((.25, .06)[number])
    e = evidence(fives, offsets, table, np.stack([d + np.float32(o) * step for o in (0, -1, -.5, .5, 1)]))
    e[:, 1:] = (e[:, 1:] - e[:, :1]) * 4
    small = np.concatenate([chain(w, e[:, i], p + 'reduce.a', p + 'reduce.b') for i in range(5)])
    extra = np.stack((squash(window(d, 5, np.max) - d), squash(window(d, 5, np.min) - d), squash(window(d, 5, np.median) - d), certainty))
    x0 = residual(w, p + 'r0', chain(w, np.concatenate((small, extra, image)).astype(np.float32), p + 'i.0', p + 'i.1'))
    x1 = residual(w, p + 'r1', chain(w, x0, p + 'd1.0', p + 'd1.1', p + 'd1.2', p + 'd1.3'))
    y = conv(w, p + 'u0', x1)
    out = conv(w, p + 'head', chain(w, up(y, x0) + x0, p + 'f0.0', p + 'f0.1'))
    return d + step * 1.5 * np.tanh(out[0]), 1 / (1 + np.exp(-out[1]))


def sample(logp, lo, step, h):
    q = np.clip((h - lo) / step, 0, len(logp) - 1)
    i = np.minimum(np.floor(q), len(logp) - 2).astype(int)
    return np.take_along_axis(logp, i, 0) * (1 - (q - i)) + np.take_along_axis(logp, i + 1, 0) * (q - i)


def main():
    w, z = Weights(sys.argv[1]), np.load(sys.argv[2])

    def compare(name, a, b=None):
        e = np.abs(a - (z[name] if b is None else b))
        print('%-24s largest difference %.2e, median %.2e, of numbers up to %.2f' % (name, e.max(), np.median(e), np.abs(a).max()))

    for name in [k[3:] for k in z.files if k.startswith('in ') and k[3:] in w.layers]:
        compare('out ' + name, conv(w, name, z['in ' + name]))
    for name in ('up3', 'up2'):
        compare('out ' + name, up(z['in ' + name], z['out ' + name]))
    fives = [five(v.astype(np.float32) / 255) for v in z['views']]
    offsets, table, (lo, hi), D = z['offsets'], z['table'], z['range'], int(z['labels'])
    ys, xs = z['pixels']
    H, W = fives[0].shape[1:]
    step = (hi - lo) / np.float32(D - 1)
    labels = (lo + (hi - lo) * np.linspace(0, 1, D, dtype=np.float32))[:, None, None] * np.ones((1, H, W), np.float32)
    image = np.concatenate((fives[0][:3] - np.float32(.4), fives[0][3:] * 4))
    compare('guide', image[:, ys, xs])
    assert (views.choose([tuple(o) for o in offsets.tolist()], 12) == table).all()
    e = evidence(fives, offsets, table, labels)
    compare('evidence', e[..., ys, xs])
    logits = volume(w, e, image)
    compare('logits', logits[:, ys, xs])
    own, second, logp = modes(logits, lo, step)
    compare('volume', own)
    compare('volume_second', second)
    r = {}
    for rounds in (1, 2):
        h = hypotheses(own, second)
        lg = selection(w, evidence(fives, offsets, table, h), image, h, sample(logp, lo, step, h), 1)
        mode, p, second, p2 = decide(h, lg)
        if rounds == 1:
            compare('hypotheses', h)
            compare('selection_logits', lg)
            for name, a in (('selected', mode), ('probability', p), ('second', second), ('second_probability', p2)):
                compare(name, a)
        d1, _ = refinement(w, 0, fives, offsets, table, image, mode, p)
        d2, c = refinement(w, 1, fives, offsets, table, image, d1, p)
        if rounds == 1:
            compare('refined', d1)
            compare('confidence', c)
        compare('map' if rounds == 1 else 'map_two_rounds', d2)
        own = mode


if __name__ == '__main__':
    main()
