# SPDX-License-Identifier: BSD-3-Clause
"""Procedural light fields with truth, drawn on the GPU."""
import functools
import math

import numpy as np
import torch
import torch.nn.functional as F

import kernels
import views

TEXTURE = 256
LAYERS = 24
POOL = 120  # scenes whose parameters are drawn together
P = {name: i for i, name in enumerate(
    'A BX BY CX CY SX SY COS SIN BOX AMPLITUDE FREQUENCY PHASE BUMP ROUND PERIOD WAVE WAVE_X WAVE_Y '
    'WAVE_PHASE LIMB POWER TEXTURE TEXTURE_C TEXTURE_S TEXTURE_X TEXTURE_Y RED GREEN BLUE'.split())}
P['MIX'] = 30
P.update({name: i for i, name in enumerate(
    'SHADOW SOFT SHADOW_X SHADOW_Y SHINE SHINE_WIDTH SHINE_DEPTH SHINE_X SHINE_Y RADIUS SLACK LAMBERT RELIEF '
    'LIGHT_X LIGHT_Y'.split(),
    39)})
PARAMETERS = 54
PARTS = ('limb', 'shadow', 'equal', 'flat', 'dark', 'aliased', 'lenslet', 'noise', 'grids', 'wave', 'big', 'uneven')


def draw_textures(count, device):
    """count patterns of zero mean and unit deviation: count N N 4, half."""
    n, dev = TEXTURE, device
    u = lambda *s, lo=0., hi=1.: torch.rand(*s, device=dev) * (hi - lo) + lo
    out = torch.zeros(count, 3, n, n, device=dev)
    slope = u(count, 1, 1, 1, lo=.15, hi=1.4)
    for octave in range(1, 9):
        m = min(2 ** octave + 1, n)
        g = torch.randn(count, 1, m, m, device=dev) * torch.randn(count, 3, 1, 1, device=dev)
        g = g + .3 * torch.randn(count, 3, m, m, device=dev)
        if m < n:
            g = F.interpolate(g, (n, n), mode='bicubic', align_corners=True)
        out += g * 2. ** (-slope * octave)
    norm = lambda t: (t - t.mean((1, 2, 3), keepdim=True)) / t.flatten(1).std(1).clamp_min(1e-4)[:, None, None, None]
    out = norm(out)
    # Patches of one colour: a quantised texture has edges but nothing between them.
    steps = u(count, 1, 1, 1, lo=.7, hi=2.5)
    out = torch.where(u(count, 1, 1, 1) < .15, (out * steps).round() / steps, out)
    y, x = torch.meshgrid(torch.linspace(-1, 1, n, device=dev), torch.linspace(-1, 1, n, device=dev), indexing='ij')
    t, f = u(count, 1, 1, hi=math.pi), 10 ** u(count, 1, 1, lo=.5, hi=1.8)
    a = torch.sin(f * (x * t.cos() + y * t.sin()) * math.pi + u(count, 1, 1, hi=6.28))
    b = torch.sin(f * u(count, 1, 1, lo=.3, hi=1.5) * (-x * t.sin() + y * t.cos()) * math.pi)
    kind, sharp = u(count, 1, 1), 10 ** u(count, 1, 1, lo=.3, hi=1.4)
    pattern = torch.where(kind < .45, torch.tanh(sharp * a), torch.where(
        kind < .75, torch.tanh(2 * sharp * a * b), torch.tanh(sharp * (a + b - 1))))[:, None]
    use = (u(count, 1, 1, 1) < .3).float()
    out = out * (1 - .8 * use) + use * pattern * torch.randn(count, 3, 1, 1, device=dev) * 1.2
    out = norm(out).clamp(-4, 4)
    return torch.cat((out, torch.zeros_like(out[:, :1])), 1).permute(0, 2, 3, 1).half().contiguous()


CENTRE = tuple(views.rectangle(9, 9, 4, 4))


@functools.lru_cache(maxsize=1000)
def chosen(offsets):
    """The views that are used, the reference first, and their tables of 6 and of 12 a sector."""
    used = sorted(set(views.choose(offsets, 12).ravel().tolist()) - {-1, 0})
    used = [offsets[0]] + [offsets[i] for i in used]
    return np.array(used, np.float32), views.choose(used, 6), views.choose(used, 12)


class Generator:
    """Draws batches; `without` leaves parts of it out (names in PARTS)."""

    def __init__(self, seed, device='cuda', bank=1024, without=()):
        self.device, self.without = device, set(without)
        torch.manual_seed(seed)
        self.rng = np.random.default_rng(seed)
        self.textures = torch.cat([draw_textures(128, device) for _ in range(bank // 128)])
        self.count, self.pool, self.size, self.margin = 0, [], 0, 0

    def has(self, part):
        return part not in self.without

    def refresh(self, n=64):
        i = int(self.rng.integers(len(self.textures) // n)) * n
        self.textures[i:i + n] = draw_textures(n, self.device)

    def grids(self, B):
        drawn = [chosen(tuple(views.draw_grid(self.rng)) if self.has('grids') else CENTRE) for _ in range(B)]
        V = max(len(c[0]) for c in drawn)
        off = np.zeros((B, V, 2), np.float32)
        for b, c in enumerate(drawn):
            off[b, :len(c[0])] = c[0]
        return (off, np.array([len(c[0]) for c in drawn], np.int32), np.stack([c[1] for c in drawn]),
                np.stack([c[2] for c in drawn]))

    def scene(self, B, S, reach):
        """Parameters of B scenes: B K PARAMETERS. reach: B, the largest offset of a view."""
        K, dev = LAYERS, self.device
        u = lambda *s, lo=0., hi=1.: torch.rand(*s, device=dev) * (hi - lo) + lo
        chance = lambda p, *s: (torch.rand(*(s or (B, K)), device=dev) < p).float()
        L = torch.zeros(B, K, PARAMETERS, device=dev)
        half = torch.tensor([1., 2., 4.], device=dev)[torch.randint(3, (B, 1), device=dev)]
        half = torch.minimum(half, 18 / reach[:, None]) * u(B, 1, lo=.3)
        middle = u(B, 1, lo=-1) * u(B, 1) * torch.minimum(4.2 - half, 18 / reach[:, None] - half).clamp_min(0)
        a = (middle + half * u(B, K, lo=-1)).sort(1).values
        back = torch.zeros(B, K, device=dev)
        back[:, 0] = 1
        few = torch.rand(B, K, device=dev) > u(B, 1, hi=.9)  # in some scenes fewer layers
        steep = chance(.5) * u(B, K, hi=.014)
        ground = back * chance(.3, B, 1) * half / S * u(B, 1, lo=.3, hi=1.3)
        angle = u(B, K, hi=6.28)
        slope = torch.randn(B, K, device=dev) * steep * (1 - .3 * back) + ground
        size = S * 10 ** u(B, K, lo=-1.35, hi=-.2)
        # Few large round things before a background with texture, shaded: what rendered scenes are made of.
        big = chance(.25, B, 1) * self.has('big')
        size = torch.where(big > 0, S * 10 ** u(B, K, lo=-.8, hi=-.1), size)
        few = few & ((big == 0) | (torch.rand(B, K, device=dev) < .3))
        thin = chance(.34) * (1 - back) * (1 - big * chance(.8, B, 1))
        sx = torch.where(thin > 0, 10 ** u(B, K, lo=-.5, hi=.5), size)
        sy = torch.where(thin > 0, size * 2, size * 10 ** u(B, K, lo=-.4, hi=.4))
        reach_of = torch.maximum(sx, sy)
        slope = torch.where(back > 0, slope, torch.minimum(slope.abs(), .8 * half / reach_of) * slope.sign())
        sx, sy = torch.where(back > 0, 1e4, sx), torch.where(back > 0, 1e4, sy)
        box = chance(.5)
        amplitude = u(B, K, hi=.35) * chance(.5)
        bump = chance(.35) * u(B, K, lo=-.12, hi=.9) * (size / S * 3).clamp(max=1) * (1 - back) * (1 - thin)
        bump = torch.where((big > 0) & (thin + back == 0), u(B, K, lo=.05, hi=1.) * (size / S * 3).clamp(max=1), bump)
        bump = torch.minimum(bump, half * 1.2)
        box = box * (1 - big * chance(.7))
        round_ = chance(.5) * (1 - box)
        period = torch.where((chance(.25) > 0) & (thin > 0), 2 * sx + 10 ** u(B, K, lo=.4, hi=1.3), 1e6)
        wave = chance(.35) * u(B, K, hi=.12) * half.clamp(max=1) * (1 - thin) * self.has('wave')
        length = S * 10 ** u(B, K, lo=-.8, hi=0.) / 6.28
        turn = u(B, K, hi=6.28)
        rot = u(B, K, hi=6.28)
        limb = torch.zeros(B, K, device=dev)
        if self.has('limb'):  # a whole scene is shaded or flat; flat ones are not to suffer
            limb = u(B, K, hi=.9) * chance(.75) * torch.maximum(chance(.45, B, 1), big * chance(.5, B, 1)) * (1 - back)
            limb = torch.where(bump > .1, limb, limb * chance(.6))
        texture = torch.randint(len(self.textures), (B, K), device=dev).float()
        contrast = 10 ** u(B, K, lo=-2.1, hi=-.55)
        if self.has('flat'):
            contrast = contrast * (1 - chance(.14)) * (1 - .97 * chance(.04, B, 1))
        base = u(B, K, 3, lo=.02, hi=.92) ** u(B, K, 1, lo=.7, hi=1.8)
        base = torch.where(chance(.4, B, K, 1) > 0, base.mean(2, keepdim=True) + .12 * (base - .4), base)
        if self.has('dark'):
            dark = chance(.15, B, 1) * back
            contrast = torch.where(dark > 0, contrast * .1, contrast)
            base = torch.where(dark[..., None] > 0, base * .08, base)
            shadowy = chance(.08, B, 1)  # a whole scene without light
            contrast, base = contrast * (1 - .85 * shadowy), base * (1 - .85 * shadowy[..., None])
        scale = 10 ** u(B, K, lo=-.35, hi=.35)
        scale = torch.where(back * chance(.15, B, 1) > 0, scale * u(B, K, lo=.12, hi=.5), scale)  # out of focus
        tx, ty = u(B, K, hi=512), u(B, K, hi=512)
        mix = torch.eye(3, device=dev) * u(B, K, 1, 1, lo=.4) + .35 * torch.randn(B, K, 3, 3, device=dev)
        mix = torch.where(chance(.4, B, K, 1, 1) > 0, mix.mean((2, 3), keepdim=True) + .1 * mix, mix)
        mix = mix * contrast[..., None, None]
        if self.has('equal'):  # the colours, or the very texture, of the layer behind
            twin = chance(.22) * (1 - back)
            whole = twin * chance(.5)
            j = (torch.rand(B, K, device=dev) * torch.arange(K, device=dev)).long()
            pick = lambda t: torch.gather(t, 1, j.view(B, K, *[1] * (t.dim() - 2)).expand(B, K, *t.shape[2:]))
            base = torch.where(twin[..., None] > 0, pick(base), base)
            mix = torch.where(twin[..., None, None] > 0, pick(mix), mix)
            texture = torch.where(whole > 0, pick(texture), texture)
        if self.has('shadow'):
            shadowed = chance(.35, B, 1)
            L[..., P['SHADOW']] = shadowed * chance(.6) * u(B, K, lo=.15, hi=.8) * (1 - back)
        if self.has('limb'):
            L[..., P['LAMBERT']] = torch.maximum(chance(.45, B, 1), big * chance(.5, B, 1)) * chance(.8) * u(B, K, lo=.3, hi=.95)
        L[..., P['RELIEF']] = 10 ** u(B, 1, lo=.7, hi=1.8)
        fall = u(B, 1, hi=6.28)
        tilt = u(B, 1, hi=1.2)
        L[..., P['LIGHT_X']], L[..., P['LIGHT_Y']] = fall.cos() * tilt, fall.sin() * tilt
        L[..., P['SOFT']] = 10 ** u(B, 1, lo=-.3, hi=1.)
        L[..., P['SHADOW_X']] = fall.cos() * u(B, 1, hi=8)
        L[..., P['SHADOW_Y']] = fall.sin() * u(B, 1, hi=8)
        shiny = chance(.2, B, 1) if self.has('lenslet') else 0.
        L[..., P['SHINE']] = shiny * chance(.4) * u(B, K, hi=.6)
        L[..., P['SHINE_WIDTH']] = 10 ** u(B, K, lo=.3, hi=1.2)
        L[..., P['SHINE_DEPTH']] = torch.randn(B, K, device=dev) * .8
        L[..., P['SHINE_X']] = torch.minimum(sx, torch.tensor(S * .5, device=dev)) * u(B, K, lo=-.7, hi=.7)
        L[..., P['SHINE_Y']] = torch.minimum(sy, torch.tensor(S * .5, device=dev)) * u(B, K, lo=-.7, hi=.7)
        cx, cy = u(B, K, lo=-.6, hi=.6) * S, u(B, K, lo=-.6, hi=.6) * S
        gone = (~few).float() * (1 - back) * torch.maximum(big, chance(.5, B, 1))
        cx = cx + gone * 1e5
        for name, value in dict(
                A=a, BX=slope * angle.cos(), BY=slope * angle.sin(), CX=cx, CY=cy, SX=sx, SY=sy,
                COS=turn.cos(), SIN=turn.sin(), BOX=box, AMPLITUDE=amplitude * (1 - back),
                FREQUENCY=torch.randint(2, 6, (B, K), device=dev).float(), PHASE=u(B, K, hi=6.28), BUMP=bump,
                ROUND=round_, PERIOD=period, WAVE=wave, WAVE_X=rot.sin() / length, WAVE_Y=rot.cos() / length,
                WAVE_PHASE=u(B, K, hi=6.28), LIMB=limb, POWER=10 ** u(B, K, lo=.2, hi=1.2), TEXTURE=texture,
                TEXTURE_C=rot.cos() * scale, TEXTURE_S=rot.sin() * scale, TEXTURE_X=tx, TEXTURE_Y=ty).items():
            L[..., P[name]] = value
        L[..., P['RED']:P['BLUE'] + 1] = base
        L[..., P['MIX']:P['MIX'] + 9] = mix.flatten(2)
        extent = torch.where(box > 0, (sx * sx + sy * sy).sqrt(), torch.maximum(sx, sy)) * (1 + amplitude) + 1
        extent = torch.where(period < 1e5, 1e6, extent)
        L[..., P['RADIUS']] = extent
        # A layer that is gone must not come back by its period.
        L[..., P['RADIUS']] = torch.where(gone > 0, 0., L[..., P['RADIUS']])
        L[..., P['SLACK']] = 1.5 * (bump.abs() + wave + slope.abs() * extent.clamp(max=2 * S))
        # Meshes: bars that repeat, and the next layer crosses them.
        cross = L[:, :-1].clone()
        cross[..., P['COS']], cross[..., P['SIN']] = -L[:, :-1, P['SIN']], L[:, :-1, P['COS']]
        mesh = (period[:, :-1] < 1e5) & (chance(.6, B, K - 1) > 0)
        L[:, 1:] = torch.where(mesh[..., None], cross, L[:, 1:])
        return L.contiguous()

    def batch(self, B, S=96, margin=None, samples=3):
        """images (packed half, B V F F 8 with F = S + 2 margin), truth (B S S), offsets, tables of 6
        and of 12 views a sector. The scenes of one pool have the same margin; it is self.margin."""
        with torch.no_grad():
            dev = self.device
            self.count += 1
            if self.count % 20 == 0:
                self.refresh()
            u = lambda *s, lo=0., hi=1.: torch.rand(*s, device=dev) * (hi - lo) + lo
            chance = lambda p, *s: (torch.rand(*s, device=dev) < p).float()
            if len(self.pool) < B or margin not in (None, self.margin) or S != self.size:
                self.size, self.margin = S, (12 if self.rng.random() < .7 else 0) if margin is None else margin
                grids = self.grids(POOL)
                reach = torch.tensor(np.abs(grids[0]).max((1, 2)), device=dev).clamp_min(1)
                self.layers = self.scene(POOL, S + self.margin, reach)
                self.grid, self.pool = grids, list(range(POOL))
            now, self.pool = self.pool[:B], self.pool[B:]
            margin, size = self.margin, S + 2 * self.margin
            t = lambda a: torch.tensor(np.ascontiguousarray(a[now]), device=dev)
            V = int(self.grid[1][now].max())
            off, counts, table6, table12 = t(self.grid[0][:, :V]), t(self.grid[1]), t(self.grid[2]), t(self.grid[3])
            layers = self.layers[now[0]:now[0] + B].contiguous()
            reach = off.abs().flatten(1).max(1).values.clamp_min(1)
            lenslet = chance(.3 * self.has('lenslet'), B, 1, 1)
            radius = off.norm(dim=2, keepdim=True) / reach[:, None, None]
            moved = off * (1 + lenslet * .02 * torch.randn(B, 1, 1, device=dev) * radius)
            moved = moved + lenslet * .03 * u(B, 1, 1) * torch.randn(B, V, 2, device=dev)
            moved[:, 0] = 0
            spread = 1 + .5 * u(B, 1) * chance(.45, B, 1) + lenslet[:, :, 0] * (
                u(B, 1, hi=.8) * radius[..., 0] ** 2 + .1 * u(B, V))
            if self.has('aliased'):
                spread = spread * (1 - chance(.12, B, 1))
            im = kernels.draw(layers, self.textures, moved, spread, counts, size, size, samples,
                              int(self.rng.integers(1 << 30)))
            # Vignetting grows away from the view's centre and with the view's offset.
            t = torch.linspace(-1, 1, size, device=dev)
            r2 = (t[:, None] ** 2 + t[None] ** 2)[None, None, None]
            shift = (t[None, None, :, None] * moved[:, :, :1, None] + t[None, None, None] * moved[:, :, 1:, None]) / reach.view(B, 1, 1, 1)
            fall = 1 - lenslet[..., None] * (.08 * u(B, 1, 1, 1) * (.5 * r2[0] + shift * radius[..., None]))
            gain = 1 + (.01 * chance(.3, B, 1) + .02 * u(B, 1) * lenslet[:, :, 0]) * torch.randn(B, V, device=dev)
            if self.has('uneven'):
                gain = gain * (1 + .06 * u(B, 1) * chance(.15, B, 1) * u(B, V, lo=-1))
                fall = fall * (1 - .25 * u(B, 1, 1, 1) * chance(.15, B, 1, 1, 1) * r2[0])  # the same in every view
            im = im * (fall * gain[..., None, None])[:, :, None]
            if self.has('noise'):
                sigma = (u(B, 1, 1, 1, 1) ** 3) * .04 * (1 - chance(.2, B, 1, 1, 1, 1))
                noise = torch.randn_like(im)
                grain = F.avg_pool2d(noise.flatten(0, 1), 3, 1, 1).view_as(noise) * 2.4
                noise = torch.where(lenslet[..., None, None] * chance(.7, B, 1, 1, 1, 1) > 0, grain, noise)
                im = im + sigma * noise * (.5 + im.clamp(0, 1).sqrt())
            im = (im.clamp(0, 1) * 255).round_().div_(255)
            d = kernels.truth(layers, S, S, 7).median(-1).values
            return kernels.pack(im), d, off, table6, table12


def turned(packed, d, off, table6, table12):
    """Another member of the dihedral group of the same scenes; colours mixed up, light changed."""
    order, sign = list(np.random.permutation(3)) + [3, 4, 5, 6, 7], torch.ones(8)
    transpose, left, down = np.random.rand(3) < .5
    if transpose:
        packed, d, off, order[3:5] = packed.transpose(2, 3), d.transpose(1, 2), off.flip(-1), [4, 3]
    axes = [i for i, f in ((3, left), (2, down)) if f]
    if axes:
        packed, d = packed.flip(axes), d.flip([a - 1 for a in axes])
    turn = lambda t, a: t[:, [(a - k) % 8 for k in range(8)]]
    if transpose:
        table6, table12 = turn(table6, 2), turn(table12, 2)
    if left:
        sign[3] = -1
        off = off * off.new_tensor([1, -1])
        table6, table12 = turn(table6, 4), turn(table12, 4)
    if down:
        sign[4] = -1
        off = off * off.new_tensor([-1, 1])
        table6, table12 = turn(table6, 0), turn(table12, 0)
    packed = packed[..., [int(i) for i in order]] * (sign * float(np.random.uniform(.5, 1.15))).to(packed)
    return packed.contiguous(), d.contiguous(), off.contiguous(), table6.contiguous(), table12.contiguous()
