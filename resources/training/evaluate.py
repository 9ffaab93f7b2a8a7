# SPDX-License-Identifier: BSD-3-Clause
"""Measures a checkpoint or released weights on scenes: evaluate.py WEIGHTS SCENES [OUT.json] [variant ...]

SCENES: a packed file or a folder (scenes.py). A variant is name=value,...: labels (0: automatic),
few, many, rounds, wide, polish (the rival's map), exact (float throughout). The first one is printed scene by scene.
"""
import json
import sys

import numpy as np
import torch

import export
import network
import scenes


def line(name, m, rival):
    text = ' '.join('%s %.3f/%.2f/%.1f/%.1f' % (k[:3], *m[k]) for k in scenes.MAPS)
    return '%-38s %s' % (name[-38:], text) + (' | rival %.3f/%.2f/%.1f/%.1f' % tuple(rival) if rival is not None else '')


def calibration(kept, all_scenes):
    """Share of pixels within .07 px for ten classes of confidence."""
    c = np.concatenate([kept[s.name]['confidence'][15:-15, 15:-15].ravel() for s in all_scenes])
    e = np.concatenate([np.abs(kept[s.name]['map'] - s.truth)[15:-15, 15:-15].ravel() for s in all_scenes])
    k = np.minimum((c * 10).astype(int), 9)
    return [(int((k == i).sum()), float(c[k == i].mean()), float((e[k == i] < .07).mean())) for i in range(10) if (k == i).any()]


def between(kept, all_scenes):
    """The mean where the selection's probability of the mode is below t, else the mode."""
    for t in (0, .5, .6, .7, .8, .85, .9, .95, .98, 1.01):
        e = [scenes.errors(np.where(kept[s.name]['p'] < t, kept[s.name]['mean'], kept[s.name]['map']), s.truth) for s in all_scenes]
        print('between t %.2f: %.3f/%.2f/%.1f/%.1f' % (t, *np.mean(e, 0)))


def main():
    torch.backends.cuda.matmul.allow_tf32 = torch.backends.cudnn.allow_tf32 = True
    if sys.argv[1].endswith('.npz'):
        net = export.read(sys.argv[1])
    else:
        net = network.Net().cuda().eval()
        net.load_state_dict({k: v.float() if v.is_floating_point() else v for k, v in torch.load(sys.argv[1], map_location='cuda').items()})
    network.channels_last(net)
    found = scenes.read_all(sys.argv[2])
    rival = {s.name: scenes.errors(s.rival, s.truth) for s in found if s.rival is not None}
    results = {'rival': {k: v.tolist() for k, v in rival.items()}}
    for number, text in enumerate(sys.argv[4:] or ['labels=40']):
        o = {k: float(v) if k == 'wide' else int(v) for k, v in (p.split('=') for p in text.split(','))}
        exact = o.pop('exact', 0)
        torch.backends.cudnn.allow_tf32 = torch.backends.cuda.matmul.allow_tf32 = not exact
        kept = {}
        r = scenes.judge(net, found, D=o.pop('labels', 40), dtype=torch.float if exact else torch.half, autocast=not exact, keep=kept, **o)
        if number == 0:
            for s in found:
                print(line(s.name, r[s.name], rival.get(s.name)))
            print('calibration:', ' '.join('%d:%.3f->%.3f' % c for c in calibration(kept, found)))
            between(kept, found)
            worst = sum(r[n]['map'][0] < rival[n][0] for n in rival), len(rival)
            print('better than the rival in MSE on', *worst)
        print(line(text, scenes.means(r), np.mean(list(rival.values()), 0) if rival else None), flush=True)
        results[text] = {n: {k: v.tolist() for k, v in m.items()} for n, m in r.items()}
    if len(sys.argv) > 3:
        json.dump(results, open(sys.argv[3], 'w'))


if __name__ == '__main__':
    main()
