# SPDX-License-Identifier: BSD-3-Clause
"""Volume -> selection among hypotheses -> two steps of refinement. README.md has every shape."""
import torch
import torch.nn as nn
import torch.nn.functional as F

import kernels

SLOPE = .1            # of the leaky ReLU
HYPOTHESES = 8
STEPS = (.25, .06)    # px, of the two refinements
OFFSETS = (0., -1., -.5, .5, 1.)
PEAK = 2              # labels on either side of a mode that are averaged
APART = 3             # labels between two modes, more than
NEAR = .1             # px: hypotheses that count as one


def conv3(i, o, stride=1, k=3):
    return nn.Sequential(nn.Conv3d(i, o, k, stride, k // 2, bias=False), nn.BatchNorm3d(o), nn.LeakyReLU(SLOPE, True))


def conv2(i, o, stride=1, dilation=1, k=3):
    return nn.Sequential(nn.Conv2d(i, o, k, stride, dilation * (k // 2), dilation, bias=False),
                         nn.BatchNorm2d(o), nn.LeakyReLU(SLOPE, True))


def residual(first, last):
    """Two layers whose output is added to their input: nothing, before they learn."""
    nn.init.zeros_(last.weight), nn.init.zeros_(last.bias)
    return nn.Sequential(first, last)


def filled(n):
    """Channels rounded up to a multiple of 8: fast in training, cut off again by the export."""
    return (n + 7) // 8 * 8


def fill(x):
    return F.pad(x, (0, 0, 0, 0, 0, filled(x.shape[1]) - x.shape[1]))


def up(x, like):
    """Twice as large, linearly; the surplus is cut off, so that nothing depends on the size."""
    y = F.interpolate(x, scale_factor=2, mode='trilinear' if x.dim() == 5 else 'bilinear', align_corners=False)
    return y[..., :like.shape[2], :like.shape[3], :like.shape[4]] if x.dim() == 5 else y[..., :like.shape[2], :like.shape[3]]


def guide(packed, margin):
    """B 5 H W of the reference view: colour - 0.4, four times its gradients."""
    m = slice(margin, -margin) if margin else slice(None)
    x = packed[:, 0, m, m, :5].permute(0, 3, 1, 2).float()
    return torch.cat((x[:, :3] - .4, x[:, 3:] * 4), 1)


def median(d, dilation):
    """Of 5 x 5 samples `dilation` apart; B H W. The border is repeated outwards."""
    n = 2 * dilation
    x = F.pad(d[:, None], (n, n, n, n), mode='replicate')
    return F.unfold(x, 5, dilation).median(1).values.view_as(d)


def highest(d, size):
    return F.max_pool2d(d[:, None], size, 1, size // 2)[:, 0]


def lowest(d, size):
    return -highest(-d, size)


def squash(t):
    return t.sign() * torch.log1p(t.abs() / .05) * .4


class Volume(nn.Module):
    def __init__(s, a=16, b=32, c=48, e=64):
        super().__init__()
        s.image = nn.Sequential(conv2(5, 16), conv2(16, 16), nn.Conv2d(16, a, 3, padding=1))
        s.input = nn.Conv3d(16, a, 3, padding=1, bias=False)
        s.norm = nn.Sequential(nn.BatchNorm3d(a), nn.LeakyReLU(SLOPE, True))
        s.e0 = conv3(a, a)
        s.d1, s.e1 = conv3(a, b, 2), conv3(b, b)
        s.d2, s.e2 = conv3(b, c, 2), nn.Sequential(conv3(c, c), conv3(c, c))
        s.r2 = residual(conv3(c, c), nn.Conv3d(c, c, 3, padding=1))
        s.d3, s.e3 = conv3(c, e, 2), nn.Sequential(conv3(e, e), conv3(e, e))
        s.r3 = residual(conv3(e, e), nn.Conv3d(e, e, 3, padding=1))
        s.u2, s.f2 = conv3(e, c, k=1), conv3(c, c)
        s.s2 = residual(conv3(c, c), nn.Conv3d(c, c, 3, padding=1))
        s.u1, s.f1 = conv3(c, b, k=1), conv3(b, b)
        s.u0, s.f0 = conv3(b, a, k=1), conv3(a, a)
        s.head = nn.Conv3d(a, 1, 3, padding=1)

    def forward(s, evidence, image):
        x0 = s.norm(s.input(evidence) + s.image(image)[:, :, None])
        x0 = x0 + s.e0(x0)
        x1 = s.e1(s.d1(x0))
        x2 = s.e2(s.d2(x1))
        x2 = x2 + s.r2(x2)
        x3 = s.e3(s.d3(x2))
        x3 = x3 + s.r3(x3)
        y2 = s.f2(up(s.u2(x3), x2) + x2)
        y2 = y2 + s.s2(y2)
        y1 = s.f1(up(s.u1(y2), x1) + x1)
        y0 = s.f0(up(s.u0(y1), x0) + x0)
        return s.head(y0)[:, 0].float()


def peak(p, labels, step, at):
    """The mean label within PEAK labels of the label number `at` (B H W), weighted by p (B D H W)."""
    D = p.shape[1]
    num = den = 0
    for k in range(-PEAK, PEAK + 1):
        i = at + k
        w = p.gather(1, i.clamp(0, D - 1)[:, None])[:, 0] * ((i >= 0) & (i < D))
        num, den = num + w * k, den + w
    return labels[:, :1, None] + (at + num / den) * step[:, None, None]


def modes(logits, labels):
    """Disparity of the highest mode, of the second (apart from it), log probabilities, all B (D) H W."""
    logp = logits.log_softmax(1)
    p = logp.exp()
    step = labels[:, 1] - labels[:, 0]
    at = p.argmax(1)
    index = torch.arange(p.shape[1], device=p.device).view(1, -1, 1, 1)
    rest = p.masked_fill((index - at[:, None]).abs() <= APART, -1.)
    return peak(p, labels, step, at), peak(p, labels, step, rest.argmax(1)), logp


def sample(logp, labels, d):
    """Log probability at disparities d (B N H W), linear between labels, constant outside."""
    step = (labels[:, 1] - labels[:, 0]).view(-1, 1, 1, 1)
    D = logp.shape[1]
    q = ((d - labels[:, :1, None, None]) / step).clamp(0, D - 1)
    i = q.floor().clamp(max=D - 2).long()
    w = q - i
    return logp.gather(1, i) * (1 - w) + logp.gather(1, i + 1) * w


class Reduce(nn.Module):
    """One small network for the evidence of each hypothesis: B 16 N H W -> B N*g H W."""

    def __init__(s, g):
        super().__init__()
        s.a, s.b = nn.Conv2d(16, 16, 1), nn.Conv2d(16, g, 1)

    def forward(s, e):
        B, C, N, H, W = e.shape
        x = e.permute(0, 2, 1, 3, 4).reshape(B * N, C, H, W)
        x = F.leaky_relu(s.b(F.leaky_relu(s.a(x), SLOPE)), SLOPE)
        return x.reshape(B, N * x.shape[1], H, W)


class Selection(nn.Module):
    def __init__(s, g=8, w=64, w1=96, w2=128):
        super().__init__()
        n = HYPOTHESES
        s.reduce = Reduce(g)
        s.i = nn.Sequential(conv2(filled(n * g + n + (n - 1) + 1 + 5), w), conv2(w, w))
        s.r0 = residual(conv2(w, w), nn.Conv2d(w, w, 3, padding=1))
        s.d1 = nn.Sequential(conv2(w, w1, 2), conv2(w1, w1))
        s.r1 = residual(conv2(w1, w1), nn.Conv2d(w1, w1, 3, padding=1))
        s.d2 = nn.Sequential(conv2(w1, w2, 2), conv2(w2, w2), conv2(w2, w2, dilation=2), conv2(w2, w2, dilation=4))
        s.d3 = nn.Sequential(conv2(w2, w2, 2), conv2(w2, w2), conv2(w2, w2, dilation=2))
        s.u2 = nn.Conv2d(w2, w2, 1)
        s.u1, s.f1 = conv2(w2, w1, k=1), conv2(w1, w1)
        s.s1 = residual(conv2(w1, w1), nn.Conv2d(w1, w1, 3, padding=1))
        s.u0, s.f0 = conv2(w1, w, k=1), conv2(w, w)
        s.head = nn.Conv2d(w, n, 3, padding=1)

    @staticmethod
    def hypotheses(d, second):
        m = median(d, 1)
        return torch.stack((d, highest(d, 5), lowest(d, 5), m, highest(m, 9), lowest(m, 9), median(d, 3), second), 1)

    def forward(s, evidence, image, h, logp, known):
        """h: B N H W; logp: B N H W, 0 where not known; known: B. Returns logits B N H W."""
        k = known.view(-1, 1, 1, 1).expand(-1, 1, *h.shape[2:])
        x = torch.cat((s.reduce(evidence), logp.clamp(-12, 0) / 4, squash(h[:, 1:] - h[:, :1]), k, image), 1)
        x0 = s.i(fill(x))
        x0 = x0 + s.r0(x0)
        x1 = s.d1(x0)
        x1 = x1 + s.r1(x1)
        x2 = s.d2(x1)
        x2 = x2 + up(s.u2(s.d3(x2)), x2)
        y1 = s.f1(up(s.u1(x2), x1) + x1)
        y1 = y1 + s.s1(y1)
        y0 = s.f0(up(s.u0(y1), x0) + x0)
        return s.head(y0).float()


def decide(h, w):
    """The mode of hypotheses h with weights w, its probability, the second one and its probability."""
    near = torch.exp(-((h[:, :, None] - h[:, None]) / NEAR) ** 2)       # B N N H W
    score = (near * w[:, None]).sum(2)
    best = score.argmax(1, keepdim=True)
    own = torch.gather(h, 1, best)
    wk = w * torch.exp(-((h - own) / NEAR) ** 2)
    mode = (wk * h).sum(1) / wk.sum(1).clamp_min(1e-9)
    far = score.masked_fill((h - own).abs() < 3 * NEAR, -1.)
    other = far.argmax(1, keepdim=True)
    p2 = torch.gather(far, 1, other)[:, 0]
    second = torch.where(p2 > 0, torch.gather(h, 1, other)[:, 0], mode)
    return mode, torch.gather(score, 1, best)[:, 0].clamp(max=1.), second, p2.clamp(0, 1)


class Refinement(nn.Module):
    def __init__(s, g=8, w=48, w1=56):
        super().__init__()
        n = len(OFFSETS)
        s.reduce = Reduce(g)
        s.i = nn.Sequential(conv2(filled(n * g + 4 + 5), w), conv2(w, w))
        s.r0 = residual(conv2(w, w), nn.Conv2d(w, w, 3, padding=1))
        s.d1 = nn.Sequential(conv2(w, w1, 2), conv2(w1, w1), conv2(w1, w1, dilation=2), conv2(w1, w1, dilation=4))
        s.r1 = residual(conv2(w1, w1), nn.Conv2d(w1, w1, 3, padding=1))
        s.u0, s.f0 = conv2(w1, w, k=1), nn.Sequential(conv2(w, w), conv2(w, w))
        s.head = nn.Conv2d(w, 2, 3, padding=1)

    def forward(s, evidence, image, d, step, certainty):
        """evidence: B 16 5 H W at d + OFFSETS step. Returns the refined d and the confidence's logit."""
        e = evidence.float()
        e = torch.cat((e[:, :, :1], (e[:, :, 1:] - e[:, :, :1]) * 4), 2)
        m = median(d, 1)
        extra = torch.stack((squash(highest(d, 5) - d), squash(lowest(d, 5) - d), squash(m - d), certainty), 1)
        x0 = s.i(fill(torch.cat((s.reduce(e), extra, image), 1)))
        x0 = x0 + s.r0(x0)
        x1 = s.d1(x0)
        x1 = x1 + s.r1(x1)
        y0 = s.f0(up(s.u0(x1), x0) + x0)
        out = s.head(y0).float()
        return d + step * 1.5 * torch.tanh(out[:, 0]), out[:, 1]


class Net(nn.Module):
    def __init__(s):
        super().__init__()
        s.volume, s.selection, s.refinement = Volume(), Selection(), nn.ModuleList(Refinement() for _ in STEPS)

    def start(s, packed, margin, offsets, few, lo, hi, D):
        """Logits of D labels between lo and hi (B), the labels, the guide."""
        labels = lo[:, None] + (hi - lo)[:, None] * torch.linspace(0, 1, D, device=lo.device)
        image = guide(packed, margin)
        e = kernels.evidence(packed, labels, few, offsets, margin, packed.dtype == torch.half)
        return s.volume(e, image), labels, image

    def select(s, packed, margin, offsets, few, image, d, second, logp, labels, known):
        """Hypotheses around d and their logits; logp None: nothing is known but d."""
        with torch.no_grad():
            h = s.selection.hypotheses(d, second)
            at = torch.zeros_like(h) if logp is None else sample(logp, labels, h) * known.view(-1, 1, 1, 1)
            e = kernels.evidence(packed, h, few, offsets, margin, False)
        return h, s.selection(e, image, h, at, known)

    def refine(s, packed, margin, offsets, many, image, d, certainty, number):
        step = STEPS[number]
        with torch.no_grad():
            d = d.detach()
            candidates = torch.stack([d + o * step for o in OFFSETS], 1)
            e = kernels.evidence(packed, candidates, many, offsets, margin, False)
        return s.refinement[number](e, image, d, step, certainty)

    def infer(s, packed, margin, offsets, few, many, lo, hi, D, given=None, rounds=1):
        """All maps on the way, for evaluation. given: a map to polish instead of the volume's."""
        r = {}
        image = guide(packed, margin)
        if given is None:
            logits, labels, image = s.start(packed, margin, offsets, few, lo, hi, D)
            d, second, logp = modes(logits, labels)
            r['volume'], r['expected'] = d, (logp.exp() * labels[:, :, None, None]).sum(1)
            known = torch.ones_like(lo)
        else:
            d, second, logp, labels, known = given, given, None, None, torch.zeros_like(lo)
        for i in range(rounds):
            h, lg = s.select(packed, margin, offsets, few, image, d, second, logp, labels, known)
            w = lg.softmax(1)
            d, p, second, p2 = decide(h, w)
        r['selected'], r['second'], r['p2'], r['weights'], r['hypotheses'], r['p'] = d, second, p2, w, h, p
        for number in range(len(STEPS)):
            d, c = s.refine(packed, margin, offsets, many, image, d, p, number)
        r['map'], r['confidence'] = d, c.sigmoid()
        r['mean'] = d + (w * (h - r['selected'][:, None])).sum(1)
        return r


def channels_last(net):
    for m in net.modules():
        if isinstance(m, nn.Conv2d):
            m.to(memory_format=torch.channels_last)
        if isinstance(m, nn.Conv3d):
            m.to(memory_format=torch.channels_last_3d)
    return net


def load(net, state):
    """Takes what has the same shape; an earlier network had one refinement for both steps."""
    own, left = net.state_dict(), []
    for name, value in own.items():
        old = name if name in state else '.'.join(p for i, p in enumerate(name.split('.')) if not (name.startswith('refinement') and i == 1))
        if old in state and state[old].shape == value.shape:
            value.copy_(state[old])
        else:
            left.append(name)
    return left
