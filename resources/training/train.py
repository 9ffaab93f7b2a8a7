# SPDX-License-Identifier: BSD-3-Clause
"""Trains the network in pieces. Each piece goes on where the checkpoint ended.

    train.py --seconds 540 --checkpoint checkpoints [--warm net.npz] [--averaged] [--still] [--rate R] [--end R]
    torchrun --standalone --nproc-per-node 2 train.py …

--warm: starts from released weights. --averaged: starts from the averaged weights. --still: holds BatchNorm
still. --revive: outputs that never learned begin anew. --end: the rate falls linearly to this value. With torchrun each card draws scenes of its own, and
the cards average their gradients.
"""
import argparse
import copy
import csv
import json
import os
import time

import numpy as np
import torch
import torch.distributed as dist
import torch.nn as nn
import torch.nn.functional as F

import export
import generator
import network
import scenes

SHAPES = ((32, 12), (40, 10), (56, 7))  # labels, scenes a batch
PARTS = ('volume', 'selection', 'refinement')
# Layers whose outputs may never have learned, and what reads them.
REVIVED = (('r0.0', 'r0.1'), ('r1.0', 'r1.1'), ('d3.0', 'd3.1.0'), ('d3.1', 'd3.2.0'), ('d3.2', 'u2'))
RANK, CARDS = (int(os.environ.get(n, d)) for n, d in (('RANK', 0), ('WORLD_SIZE', 1)))


def arguments():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument('--seconds', type=float, required=True)
    p.add_argument('--checkpoint', default='checkpoints')
    p.add_argument('--out', help='where the checkpoint is written (default: where it was read)')
    p.add_argument('--warm', help='released weights (net.npz) to start from where there is no checkpoint')
    p.add_argument('--still', action='store_true', help='hold BatchNorm still')
    p.add_argument('--revive', action='store_true', help='begin outputs of REVIVED that never learned anew')
    p.add_argument('--size', type=int, default=96, help='rows and columns of a scene; larger ones are fewer a batch')
    p.add_argument('--times', type=float, default=1., help='scenes a batch, relative to SHAPES')
    p.add_argument('--averaged', action='store_true', help='start from the averaged weights')
    p.add_argument('--rate', type=float, default=1.5e-3)
    p.add_argument('--end', type=float, help='rate at the end of the piece (default: the same)')
    p.add_argument('--new-rate', type=float, default=1., help='of the rate, for layers that the weights of --warm lack')
    p.add_argument('--volume-rate', type=float, default=.4, help='of the rate, for the volume')
    p.add_argument('--volume-every', type=int, default=2, help='batches between updates of the volume')
    p.add_argument('--seed', type=int, default=1)
    p.add_argument('--scenes', help='scenes to watch: a packed file or a folder')
    p.add_argument('--without', default='', help='parts of the generator to leave out')
    p.add_argument('--set', default='', help='name=value of constants of the network, for ablations')
    p.add_argument('--every', type=float, default=90, help='seconds between looks')
    p.add_argument('--report', action='store_true', help='print every scene at the end')
    return p.parse_args()


def spoil(d):
    """Truth with the faults of estimates: fat, thin and soft silhouettes, shifts, noise, patches."""
    B, H, W = d.shape
    dev = d.device
    field = lambda n, c=1: F.interpolate(torch.randn(B, c, n, n, device=dev), (H, W), mode='bicubic', align_corners=True)[:, 0]
    chance = lambda p: (torch.rand(B, 1, 1, device=dev) < p).float()
    size = int(np.random.choice([3, 5, 5, 7, 9, 11]))
    f = field(int(np.random.choice([6, 12, 24])))
    s = torch.where(f > .4, network.highest(d, size), torch.where(f < -.4, network.lowest(d, size), d))
    dx, dy = np.random.randint(-1, 2, 2)
    s = torch.where(chance(.3) > 0, torch.roll(s, (int(dy), int(dx)), (1, 2)), s)
    soft = F.avg_pool2d(s[:, None], 5, 1, 2, count_include_pad=False)[:, 0]
    s = torch.where((chance(.35) > 0) & (field(12) > -.3), soft, s)
    s = s + chance(.7) * .08 * torch.rand(B, 1, 1, device=dev) * field(24) + chance(.4) * .03 * torch.randn_like(s)
    # Anything at jumps, in some places; grains of anything.
    low, high = d.flatten(1).min(1).values[:, None, None], d.flatten(1).max(1).values[:, None, None]
    any_ = low + (high - low) * torch.rand_like(d)
    jump = network.highest(d, 5) - network.lowest(d, 5) > .3
    s = torch.where(jump & (field(12) > .5) & (torch.rand_like(d) < .5) & (chance(.5) > 0), any_, s)
    s = torch.where((torch.rand_like(d) < .03 * torch.rand(B, 1, 1, device=dev)) & (chance(.3) > 0), any_, s)
    patch = field(24)
    other = torch.roll(s, (int(np.random.randint(-20, 21)), int(np.random.randint(-20, 21))), (1, 2))
    return torch.where((patch > 2.) & (chance(.5) > 0), other, s)


def ranges(d):
    """The labels' range: the truth's with a margin, in a quarter of the scenes up to twice as wide."""
    B, dev = len(d), d.device
    u = lambda lo, hi: torch.rand(B, device=dev) * (hi - lo) + lo
    low, high = d.flatten(1).min(1).values, d.flatten(1).max(1).values
    w = (high - low).clamp_min(.4)
    wide = (torch.rand(B, device=dev) < .25).float() * u(0, 1)
    side = u(0, 1)
    return low - w * (u(.02, .15) + wide * side), low + w * (1 + u(.02, .15) + wide * (1 - side))


def revive(weights, seed):
    """Gives outputs of REVIVED with hardly any weight random ones, and what reads them small ones (a state of the network)."""
    torch.manual_seed(seed)
    for name, reader in REVIVED:
        conv, norm = f'selection.{name}.0.weight', f'selection.{name}.1.'
        spread = (weights[norm + 'running_var'] + 1e-5).sqrt()
        size = weights[conv].flatten(1).abs().amax(1) * (weights[norm + 'weight'] / spread).abs()
        dead = size < .05 * size.topk(8).values.median()
        weights[conv][dead] = torch.randn_like(weights[conv][dead]) * (2 / weights[conv][0].numel()) ** .5
        weights[norm + 'weight'][dead] = .3 * spread[dead]
        weights[norm + 'bias'][dead] = weights[norm + 'running_mean'][dead]
        read = weights[f'selection.{reader}.weight']
        read[:, dead] = torch.randn_like(read[:, dead]) * read[:, ~dead].std() * .1
        print(name, 'begins anew:', int(dead.sum()), 'of', len(dead), flush=True)


class Trainer:
    def __init__(self, a):
        self.a, dev = a, 'cuda'
        self.net = network.channels_last(network.Net().to(dev))
        self.done = dict(iteration=0, seconds=0., pieces=[])
        path = lambda n: os.path.join(a.checkpoint, n)
        if a.averaged and os.path.exists(path('ema.pt')):
            network.load(self.net, torch.load(path('ema.pt'), map_location=dev))
            self.done = json.load(open(path('state.json')))
        elif os.path.exists(path('net.pt')):
            print('new:', network.load(self.net, torch.load(path('net.pt'), map_location=dev)))
            self.done = json.load(open(path('state.json')))
        elif a.warm:
            self.done['new'] = export.unfold(self.net, a.warm)
            print('new:', self.done['new'])
        if a.revive:
            with torch.no_grad():
                revive(self.net.state_dict(), a.seed)
        self.ema = copy.deepcopy(self.net).eval().requires_grad_(False)
        if os.path.exists(path('ema.pt')) and not a.revive:
            network.load(self.ema, torch.load(path('ema.pt'), map_location=dev))
        groups = [dict(params=[p for n, p in self.net.named_parameters() if n.startswith(part + '.') and self.is_new(n) == new],
                       factor=(a.volume_rate if part == 'volume' else 1.) * (a.new_rate if new else 1.))
                  for new in (False, True) for part in PARTS]
        self.opt = torch.optim.AdamW([g for g in groups if g['params']], a.rate, weight_decay=1e-4, betas=(.9, .99), fused=True)
        if os.path.exists(path('opt.pt')):
            self.opt.load_state_dict(torch.load(path('opt.pt'), map_location=dev))
        self.seed = a.seed * 1000003 + self.done['iteration']
        np.random.seed(self.seed % (1 << 32))  # the same on all cards: shapes of batches
        without = [w for w in a.without.split(',') if w]
        self.gen = generator.Generator(self.seed + 500009 * RANK, without=without)
        self.net.train()
        self.kept = None
        if a.warm and not self.done['iteration']:
            self.calibrate()
        if CARDS > 1:
            for v in [*self.net.state_dict().values(), *self.ema.state_dict().values()]:
                dist.broadcast(v, 0)
        if a.still:
            for m in self.net.modules():
                if isinstance(m, export.NORM):
                    m.eval()

    def is_new(self, name):
        """Whether the weights of --warm lacked this layer."""
        return any(name.startswith(n + '.') for n in self.done.get('new', ()))

    def calibrate(self, batches=24):
        """BatchNorm of released weights only adds a bias (export.unfold). It gets the mean and the variance of
        what it sees in training, and a scale and a shift with which its output stays the same; that of new
        layers begins with a mean of 0 and a variance of 1."""
        names = {m: n for n, m in self.net.named_modules() if isinstance(m, export.NORM)}
        seen = {m: [] for m in names}
        hooks = [m.register_forward_pre_hook(lambda m, x: seen[m].append(torch.stack(
            [(x[0].float() ** k).transpose(0, 1).flatten(1).mean(1) for k in (1, 2)]))) for m in seen]
        self.net.eval()
        with torch.no_grad():
            for _ in range(batches):
                self.losses(8, 40, False)
            for m, s in seen.items():
                mean, square = torch.stack(s).mean(0)
                m.running_mean.copy_(mean)
                m.running_var.copy_((square - mean ** 2).clamp_min(0))
                if not self.is_new(names[m]):
                    m.bias.add_(mean)
                    m.weight.copy_((m.running_var + m.eps).sqrt())
        for h in hooks:
            h.remove()
        self.net.train()
        network.load(self.ema, self.net.state_dict())

    def save(self, out):
        os.makedirs(out, exist_ok=True)
        torch.save(self.net.state_dict(), f'{out}/net.pt')
        torch.save({k: v.half() if v.is_floating_point() else v for k, v in self.ema.state_dict().items()}, f'{out}/ema.pt')
        state = self.opt.state_dict()  # moments in half as many bytes
        for s in state['state'].values():
            for k in ('exp_avg', 'exp_avg_sq'):
                s[k] = s[k].bfloat16()
        torch.save(state, f'{out}/opt.pt')
        json.dump(self.done, open(f'{out}/state.json', 'w'))

    def losses(self, B, D, train_volume):
        net = self.net
        # Each batch is used twice, the second time turned.
        if self.kept is None:
            self.kept = self.gen.batch(B, self.a.size)
            packed, d, off, few, many = self.kept
        else:
            packed, d, off, few, many = generator.turned(*self.kept)
            self.kept = None
        margin = self.gen.margin
        few = many if np.random.rand() < .5 else few
        lo, hi = ranges(d)
        out = {}
        with torch.autocast('cuda', torch.bfloat16):
            with torch.set_grad_enabled(train_volume):
                logits, labels, image = net.start(packed, margin, off, few, lo, hi, D)
            step = (labels[:, 1] - labels[:, 0])[:, None, None]
            with torch.autocast('cuda', enabled=False), torch.set_grad_enabled(train_volume):
                own, second, logp = network.modes(logits, labels)
                if train_volume:
                    q = ((d - lo[:, None, None]) / step).clamp(0, D - 1.001)
                    i = q.floor().long()
                    w = q - i
                    at_jumps = 1 + 2. * (network.highest(d, 3) - network.lowest(d, 3) > .3)
                    out['ce'] = -(at_jumps * (logp.gather(1, i[:, None])[:, 0] * (1 - w) + logp.gather(1, i[:, None] + 1)[:, 0] * w)).mean()
                    good = ((own - d).abs() < 1.5 * step).float()
                    out['peak'] = (F.smooth_l1_loss(own / step, d / step, beta=.1, reduction='none') * good).mean()
            known = (torch.rand(B, device=d.device) < .7).float()
            k = known[:, None, None] > 0
            given = spoil(d)
            own, second = torch.where(k, own.detach(), given), torch.where(k, second.detach(), given)
            if np.random.rand() < .35:  # a second selection goes on from the first one's result
                with torch.no_grad():
                    h, lg = net.select(packed, margin, off, few, image, own, second, logp.detach(), labels, known)
                    own, _, second, _ = network.decide(h, lg.softmax(1))
            h, lg = net.select(packed, margin, off, few, image, own, second, logp.detach(), labels, known)
            with torch.autocast('cuda', enabled=False):
                w = lg.softmax(1)
                spread = (h.max(1).values - h.min(1).values).clamp(max=3)
                like = (w * torch.exp(-(h - d[:, None]).abs() / .08)).sum(1)
                out['select'] = (-torch.log(like + 1e-3) * (.3 + spread + .5 * spread ** 2)).mean()
                out['mean'] = F.smooth_l1_loss((w * h).sum(1), d)  # its square up to 1 px: a proper score of the mean
                with torch.no_grad():
                    mode, p, _, _ = network.decide(h, w)
                    shake = (torch.rand(B, 1, 1, device=d.device) < .4).float() * .05
                    mode = mode + shake * torch.rand(B, 1, 1, device=d.device) * torch.randn_like(mode)
            d1, _ = net.refine(packed, margin, off, many, image, mode, p, 0)
            d2, c = net.refine(packed, margin, off, many, image, d1, p, 1)
            with torch.autocast('cuda', enabled=False):
                near = ((mode - d).abs() < .4).float()
                out['refine1'] = (F.smooth_l1_loss(d1 / .25, d / .25, beta=.1, reduction='none') * near).mean()
                near = ((d1.detach() - d).abs() < .15).float()
                out['refine2'] = (F.smooth_l1_loss(d2 / .06, d / .06, beta=.2, reduction='none') * near).mean()
                out['certain'] = F.binary_cross_entropy_with_logits(c, ((d2.detach() - d).abs() < .07).float())
        with torch.no_grad():
            out['mse'] = 100 * ((d2 - d) ** 2).mean()
            out['bad'] = 100 * ((d2 - d).abs() > .07).float().mean()
        return out

    def average(self, share):
        pairs = [(x, y) for x, y in zip(self.ema.state_dict().values(), self.net.state_dict().values()) if x.is_floating_point()]
        with torch.no_grad():
            torch._foreach_lerp_([x for x, _ in pairs], [y for _, y in pairs], share)

    def share_gradients(self):
        grads = [p.grad for p in self.net.parameters() if p.grad is not None]
        flat = torch.cat([g.flatten() for g in grads])
        dist.all_reduce(flat, dist.ReduceOp.AVG)
        for g, part in zip(grads, flat.split([g.numel() for g in grads])):
            g.copy_(part.view(g.shape))

    def step(self, rate):
        it = self.done['iteration']
        if self.kept is None:
            self.shape = SHAPES[int(np.random.choice(3, p=(.35, .45, .2)))]
        D, B = self.shape[0], round(self.shape[1] * self.a.times * (96 / self.a.size) ** 2)
        train_volume = it % 4 in ((0, 1, 2, 3), (0, 3), (0,))[self.a.volume_every - 1]
        out = self.losses(B, D, train_volume)
        loss = out['select'] + 4 * out['mean'] + out['refine1'] + out['refine2'] + .3 * out['certain']
        if train_volume:
            loss = loss + .5 * out['ce'] + .3 * out['peak']
        self.opt.zero_grad(set_to_none=True)
        loss.backward()
        if CARDS > 1:
            self.share_gradients()
        for g in self.opt.param_groups:
            g['lr'] = rate * g['factor']
            nn.utils.clip_grad_norm_(g['params'], 2.)
        self.opt.step()
        if it % 4 == 3:
            self.average(.008 if self.a.end == 0 else max(.004, 1 / (it / 4 + 5.)))
        self.done['iteration'] += 1
        return out


def procedural(seed, batches=8):
    """Batches of scenes with a seed of their own, to choose with."""
    g = generator.Generator(seed, bank=256)
    state = np.random.get_state(), torch.get_rng_state(), torch.cuda.get_rng_state()
    torch.manual_seed(seed)
    kept = [g.batch(6, margin=12) for _ in range(batches)]
    np.random.set_state(state[0]), torch.set_rng_state(state[1]), torch.cuda.set_rng_state(state[2])
    return kept


def look(net, batches, D=40):
    """As scenes.errors, but no error counts for more than 1 px: some scenes cannot be seen."""
    total = {k: [] for k in scenes.MAPS}
    with torch.no_grad(), torch.autocast('cuda', torch.bfloat16):
        for packed, d, off, few, many in batches:
            low, high = d.flatten(1).min(1).values - .1, d.flatten(1).max(1).values + .1
            r = net.infer(packed, 12, off, few, many, low, high, D)
            for k in scenes.MAPS:
                e = (r[k] - d).abs().clamp(max=1)
                total[k].append(np.array([100 * (e ** 2).mean().item()] + [100 * (e > t).float().mean().item() for t in (.07, .03, .01)]))
    return {k: np.mean(v, 0) for k, v in total.items()}


class Clock:
    """Seconds since the start; on all cards those of the first."""

    def __init__(self):
        self.start = time.time()
        self.group = dist.new_group(backend='gloo') if CARDS > 1 else None

    def __call__(self):
        elapsed = torch.tensor([time.time() - self.start], dtype=torch.double)
        if self.group is not None:
            dist.broadcast(elapsed, 0, group=self.group)
        return float(elapsed)


def main():
    a = arguments()
    if CARDS > 1:
        torch.cuda.set_device(int(os.environ['LOCAL_RANK']))
        dist.init_process_group('nccl', device_id=torch.device('cuda', torch.cuda.current_device()))
    torch.backends.cuda.matmul.allow_tf32 = torch.backends.cudnn.allow_tf32 = True
    torch.backends.cudnn.benchmark = True
    begun = time.time()
    for pair in filter(None, a.set.split(',')):
        name, value = pair.split('=')
        setattr(network, name, json.loads(value))
    held_out = procedural(999000 + a.seed) if RANK == 0 else []
    t = Trainer(a)
    watched = scenes.read_all(a.scenes) if a.scenes and RANK == 0 else []
    print(torch.cuda.get_device_name(), {n: sum(p.numel() for p in getattr(t.net, n).parameters()) for n in PARTS},
          'starts at', t.done['iteration'], 'after %.0f s' % (time.time() - begun), flush=True)
    first, clock, start, looked, seconds = t.done['iteration'], Clock(), time.time(), time.time(), t.done['seconds']
    budget = a.seconds - (start - begun)
    sums, rows, marks = {}, [], {100, 400}
    while (elapsed := clock()) < budget:
        it = t.done['iteration'] - first
        rate = a.rate if a.end is None else a.rate + (a.end - a.rate) * max(0., elapsed / budget)
        out = t.step(rate * min(1., (it + 1) / 200))
        if RANK:
            continue
        for k, v in out.items():
            s = sums.setdefault(k, [0., 0])
            s[0], s[1] = s[0] + v.detach(), s[1] + 1
        it += 1
        if it in marks or time.time() - looked > a.every or time.time() - start >= budget:
            looked = time.time()
            t.done['seconds'] = seconds + looked - start
            shown = {k: float(s[0] / s[1]) for k, s in sums.items()}
            sums = {}
            m = look(t.ema, held_out)
            row = dict(iteration=t.done['iteration'], seconds=round(t.done['seconds']), rate='%.2e' % rate,
                       **{k: '%.4f' % v for k, v in shown.items()})
            for k in scenes.MAPS:
                row.update({f'procedural_{k}_mse': '%.3f' % m[k][0], f'procedural_{k}_bad': '%.3f' % m[k][1]})
            if watched:
                r = scenes.judge(t.ema, watched)
                m2 = scenes.means(r)
                for k in scenes.MAPS:
                    row.update({f'choosing_{k}_mse': '%.3f' % m2[k][0], f'choosing_{k}_bad': '%.3f' % m2[k][1]})
            rows.append(row)
            short = lambda m: ' '.join('%s %.2f/%.2f/%.1f' % (k[:3], *m[k][:3]) for k in scenes.MAPS)
            print('%d %.0f s %.1f GB' % (t.done['iteration'], elapsed, torch.cuda.max_memory_allocated() / 1e9),
                  ' '.join('%s %.3f' % (k, v) for k, v in shown.items()), '| procedural', short(m),
                  '| choosing ' + short(m2) if watched else '', flush=True)
    t.done['pieces'].append(dict(seed=t.seed, iterations=t.done['iteration'] - first, seconds=round(time.time() - start),
                                 card=torch.cuda.get_device_name(), cards=CARDS, rate=a.rate, end=a.end))
    if CARDS > 1:
        dist.destroy_process_group()
    if RANK:
        return
    out = a.out or a.checkpoint
    t.save(out)
    path = os.path.join(out, 'curve.csv')
    with open(path, 'w', newline='') as f:
        w = csv.DictWriter(f, sorted({k for r in rows for k in r}, key=list(rows[-1]).index))
        w.writeheader()
        w.writerows(rows)
    if a.report and watched:
        for name, m in scenes.judge(t.ema, watched).items():
            print('%-40s' % name, ' | '.join('%s %.3f/%.2f/%.1f/%.1f' % (k, *m[k]) for k in scenes.MAPS))


if __name__ == '__main__':
    main()
