# SPDX-License-Identifier: BSD-3-Clause
"""Writes the released weights and the test vectors of the engine.

    export.py CHECKPOINT net.npz COMMIT DATE [net_vectors.npz]

The weights have BatchNorm folded into them. Those of large layers are `NAME.weight`, of 8 bits, times
`NAME.scale` of their output; all other numbers are half precision. The vectors are computed from these
in float. `record` is JSON in UTF-8 bytes.
"""
import copy
import hashlib
import json
import sys

import numpy as np
import torch
import torch.nn as nn
import torch.nn.functional as F

import generator
import kernels
import network
import views

VERSION = 8
LARGE = 10000    # weights of a layer that are kept in 8 bits, at least
CONV, NORM = (nn.Conv2d, nn.Conv3d), (nn.BatchNorm2d, nn.BatchNorm3d)


def scale_of(norm):
    g = norm.weight / (norm.running_var + norm.eps).sqrt()
    return g, norm.bias - norm.running_mean * g


def fold(net):
    net = copy.deepcopy(net).eval()
    with torch.no_grad():
        for m in net.modules():
            if isinstance(m, nn.Sequential) and len(m) > 1 and isinstance(m[0], CONV) and isinstance(m[1], NORM):
                c, (g, shift) = m[0], scale_of(m[1])
                n = type(c)(c.in_channels, c.out_channels, c.kernel_size, c.stride, c.padding, c.dilation).to(c.weight.device)
                n.weight.copy_(c.weight * g.view(-1, *[1] * (c.weight.dim() - 1)))
                n.bias.copy_(shift)
                m[0], m[1] = n, nn.Identity()
        v = net.volume
        g, shift = scale_of(v.norm[0])
        v.input.weight.mul_(g.view(-1, 1, 1, 1, 1))
        v.image[2].weight.mul_(g.view(-1, 1, 1, 1))
        v.image[2].bias.mul_(g).add_(shift)
        v.norm[0] = nn.Identity()
    return net


def layers(net, second=(nn.Identity,)):
    """name -> convolution, whether a leaky ReLU follows directly. second: what stands between the two."""
    found, inside = {}, set()
    for name, m in net.named_modules():
        if isinstance(m, nn.Sequential) and len(m) == 3 and isinstance(m[0], CONV) and isinstance(m[1], second):
            found[name] = m[0], True
            inside.add(m[0])
    for name, m in net.named_modules():
        if isinstance(m, CONV) and m not in inside:
            found[name] = m, '.reduce.' in name
    return found


def real_inputs(name, conv):
    """Channels without those that fill up to a multiple of 8."""
    n, k = network.HYPOTHESES, len(network.OFFSETS)
    if name == 'selection.i.0':
        return n * 8 + n + (n - 1) + 1 + 5
    if name.startswith('refinement.') and name.endswith('.i.0'):
        return k * 8 + 4 + 5
    return conv.in_channels


def architecture(net):
    return dict(
        sectors=views.SECTORS, views_per_sector=12, rounds=2, evidence=dict(floor=.003, add=4.2, scale=.8, none=1.5),
        guide=dict(colour_minus=.4, gradient_times=4), leaky_slope=network.SLOPE, labels=dict(step=.1, least=32, most=64, multiple=8),
        peak=network.PEAK, apart=network.APART, near=network.NEAR, steps=network.STEPS, offsets=network.OFFSETS, reach=1.5,
        difference_times=4, hypotheses=['own', 'max 5', 'min 5', 'median 5', 'max 9 of median 5', 'min 9 of median 5',
                                        'median 5 dilated 3', 'second'],
        squash=dict(unit=.05, scale=.4), log_probability=dict(least=-12, divided_by=4), confidence_px=.07,
        layers={n: dict(dimensions=c.weight.dim() - 2, inputs=real_inputs(n, c), outputs=c.out_channels, kernel=c.kernel_size[0],
                        stride=c.stride[0], dilation=c.dilation[0], bias=c.bias is not None, activation=a)
                for n, (c, a) in layers(net).items()})


def stored(name, weight):
    """The arrays that hold a layer's weights (numpy, float; outputs first)."""
    if weight.size < LARGE:
        return {name + '.weight': weight.astype(np.float16)}
    column = (-1, *[1] * (weight.ndim - 1))
    scale = (np.abs(weight).reshape(len(weight), -1).max(1) / 127).astype(np.float16)
    scale[scale == 0] = 1  # of an output that has died
    levels = np.rint(weight / scale.astype(np.float32).reshape(column)).clip(-127, 127)
    return {name + '.weight': levels.astype(np.int8), name + '.scale': scale}


def restored(arrays, name):
    """What `stored` held, in float."""
    weight = arrays[name + '.weight'].astype(np.float32)
    if name + '.scale' not in arrays:
        return weight
    return weight * arrays[name + '.scale'].astype(np.float32).reshape(-1, *[1] * (weight.ndim - 1))


def write(net, path, training):
    arrays = {}
    for name, (c, _) in layers(net).items():
        arrays.update(stored(name, c.weight.detach()[:, :real_inputs(name, c)].float().cpu().numpy()))
        if c.bias is not None:
            arrays[name + '.bias'] = c.bias.detach().half().cpu().numpy()
    digest = hashlib.sha256()
    for name in sorted(arrays):
        digest.update(name.encode())
        digest.update(arrays[name].tobytes())
    record = dict(name='net', version=VERSION, sha256=digest.hexdigest(),
                  hashed='names in UTF-8 and bytes of the arrays, sorted by name', architecture=architecture(net),
                  training=training, weights=int(sum(a.size for n, a in arrays.items() if not n.endswith('.scale'))))
    arrays['record'] = np.frombuffer(json.dumps(record, indent=1).encode(), np.uint8)
    np.savez(path, **arrays)
    return record


def read(path, device='cuda'):
    """The released network, in float."""
    net, z = fold(network.Net()).to(device), np.load(path)
    with torch.no_grad():
        for name, (c, _) in layers(net).items():
            w = torch.tensor(restored(z, name))
            c.weight.zero_()
            c.weight[:, :w.shape[1]] = w.to(device)
            if c.bias is not None:
                c.bias.copy_(torch.tensor(z[name + '.bias'].astype(np.float32)))
    return network.channels_last(net).eval()


def unfold(net, path):
    """Puts released weights into a network with BatchNorm, which only adds the bias (Trainer.calibrate goes on).
    Returns the names of the layers that the file lacks."""
    z = np.load(path)
    found = [n[:-7] for n in z.files if n.endswith('.weight')]
    with torch.no_grad():
        for m in net.modules():
            if isinstance(m, NORM):
                m.running_mean.zero_(), m.running_var.fill_(1 - m.eps), m.weight.fill_(1), m.bias.zero_()
        for name in found:
            m = net.get_submodule(name)
            folded = isinstance(m, nn.Sequential)
            c, w = m[0] if folded else m, torch.tensor(restored(z, name))
            c.weight.zero_()
            c.weight[:, :w.shape[1]] = w.to(c.weight.device)
            if name + '.bias' in z.files:
                (m[1] if folded else c).bias.copy_(torch.tensor(z[name + '.bias'].astype(np.float32)))
    return sorted(set(layers(net, NORM)) - set(found))


def vectors(net, path):
    """Inputs and outputs of single layers and of the whole, for the engine's tests."""
    torch.backends.cudnn.allow_tf32 = torch.backends.cuda.matmul.allow_tf32 = False
    torch.backends.cudnn.benchmark = False
    g = generator.Generator(77, bank=128, without=('grids', 'lenslet', 'flat'))
    rng, out = np.random.default_rng(77), {}
    np.random.seed(77)
    with torch.no_grad():
        # A light field of 5x5 views of 32x28 pixels.
        H, W = 28, 32
        packed, d, off, _, _ = g.batch(8, S=32, margin=0)
        b = int(((d.flatten(1).max(1).values - d.flatten(1).min(1).values) - 1.5).abs().argmin())
        grid = views.rectangle(5, 5, 2, 2)
        number = {tuple(int(x) for x in o): i for i, o in enumerate(off[b].tolist())}
        im = torch.stack([packed[b, number[o], :H, :W, :3] for o in grid]).float()
        im = (im * 255).round().byte()
        scene = (im.permute(0, 3, 1, 2)[None].float() / 255)
        p = kernels.pack(scene, torch.float)
        offsets = torch.tensor(np.array(grid, np.float32)).cuda()[None]
        table = torch.tensor(views.choose(grid, 12)).cuda()[None]
        truth = d[b, :H, :W]
        lo, hi, D = truth.min()[None] - .1, truth.max()[None] + .1, 32
        out.update(views=im.cpu().numpy(), offsets=np.array(grid, np.int8), table=table[0].cpu().numpy().astype(np.int8),
                   range=np.array([lo.item(), hi.item()], np.float32), labels=np.array(D, np.int32), truth=truth.cpu().numpy())
        ys, xs = np.array([0, 5, 13, 14, 27, 20, 9, 27]), np.array([0, 9, 16, 31, 31, 3, 22, 1])
        at = lambda t: t[..., torch.tensor(ys), torch.tensor(xs)].cpu().numpy()
        lab = lo[:, None] + (hi - lo)[:, None] * torch.linspace(0, 1, D, device='cuda')
        e = kernels.evidence(p, lab, table, offsets, 0, False)
        logits, labels, image = net.start(p, 0, offsets, table, lo, hi, D)
        out.update(pixels=np.stack([ys, xs]).astype(np.int32), evidence=at(e[0]), logits=at(logits[0]), guide=at(image[0]))
        own, second, logp = network.modes(logits, labels)
        h, lg = net.select(p, 0, offsets, table, image, own, second, logp, labels, torch.ones_like(lo))
        out.update(volume=own[0], volume_second=second[0], hypotheses=h[0], log_probability=at(network.sample(logp, labels, h)[0]),
                   selection_logits=lg[0], hypothesis_evidence=at(kernels.evidence(p, h, table, offsets, 0, False)[0]))
        mode, prob, other, p2 = network.decide(h, lg.softmax(1))
        d1, _ = net.refine(p, 0, offsets, table, image, mode, prob, 0)
        d2, c = net.refine(p, 0, offsets, table, image, d1, prob, 1)
        out.update(selected=mode[0], probability=prob[0], second=other[0], second_probability=p2[0], refined=d1[0], map=d2[0],
                   confidence=c[0].sigmoid())
        polished = net.infer(p, 0, offsets, table, table, lo, hi, D, given=truth[None] + .03)
        out.update(polished=polished['map'][0])
        twice = net.infer(p, 0, offsets, table, table, lo, hi, D, rounds=2)
        out.update(map_two_rounds=twice['map'][0])
        # Single layers on random numbers.
        found = layers(net)
        for name, shape in (('volume.e0', (16, 3, 5, 6)), ('volume.d1', (16, 5, 5, 6)), ('volume.u2', (64, 2, 2, 3)),
                            ('selection.d1.0', (64, 7, 8)), ('refinement.0.d1.3', (56, 9, 7)), ('refinement.1.head', (48, 4, 5))):
            conv, active = found[name]
            x = torch.tensor(rng.normal(size=(1, *shape)).astype(np.float32)).cuda()
            y = conv(x)
            out['in ' + name], out['out ' + name] = x[0], (F.leaky_relu(y, network.SLOPE) if active else y)[0]
        x = torch.tensor(rng.normal(size=(1, 2, 3, 3, 4)).astype(np.float32)).cuda()
        out['in up3'], out['out up3'] = x[0], network.up(x, torch.zeros(1, 1, 6, 5, 8, device='cuda'))[0]
        x = x[:, :, 0]
        out['in up2'], out['out up2'] = x[0], network.up(x, torch.zeros(1, 1, 5, 7, device='cuda'))[0]
    for size in (9, 17):
        grid = views.rectangle(size, size, size // 2, size // 2)
        for cap in (6, 12):
            table = views.choose(grid, cap)
            out[f'chosen_{size}_{cap}'] = np.array([[grid[i] for i in row] for row in table], np.int8)
    np.savez(path, **{k: v.cpu().numpy() if torch.is_tensor(v) else v for k, v in out.items()})


def weights_of(checkpoints):
    """The mean of the weights of checkpoints."""
    all = [torch.load(c + '/ema.pt', map_location='cuda') for c in checkpoints]
    mean = lambda k, v: (sum(one[k].float() for one in all) / len(all)).to(v.dtype).float()
    return {k: mean(k, v) if v.is_floating_point() else v for k, v in all[-1].items()}


def main():
    """export.py CHECKPOINT[,CHECKPOINT…] NET.NPZ COMMIT DATE [VECTORS.NPZ]: several are averaged; the last has the record."""
    checkpoints, path, commit, date = sys.argv[1].split(','), *sys.argv[2:5]
    net = network.Net().cuda().eval()
    net.load_state_dict(weights_of(checkpoints))
    done = json.load(open(checkpoints[-1] + '/state.json'))
    r = write(fold(net), path, dict(commit=commit, date=date, iterations=done['iteration'],
                                    hours=round(sum(p['seconds'] for p in done['pieces']) / 3600, 3), pieces=done['pieces'],
                                    data='procedural light fields drawn by generator.py alone'))
    print('weights', r['weights'], r['sha256'])
    if len(sys.argv) > 5:
        vectors(read(path), sys.argv[5])


if __name__ == '__main__':
    main()
