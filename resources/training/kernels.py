# SPDX-License-Identifier: BSD-3-Clause
"""Calls the kernels of kernels.cu on PyTorch's tensors."""
import os

import cupy
import numpy as np
import torch

HERE = os.path.dirname(os.path.abspath(__file__))
_module = None


def module():
    global _module
    if _module is None:
        home = os.environ.get('CUDA_HOME', '/usr/local/cuda')
        with open(os.path.join(HERE, 'kernels.cu')) as f:
            _module = cupy.RawModule(code=f.read(), options=(
                '-std=c++17', '--use_fast_math', '-I' + os.path.join(home, 'include')))
    return _module


def call(name, grid, block, *args):
    values = tuple(np.uint64(a.data_ptr()) if isinstance(a, torch.Tensor) else np.int32(a) for a in args)
    with cupy.cuda.ExternalStream(torch.cuda.current_stream().cuda_stream):
        module().get_function(name)(grid, block, values)


def blocks(n, size=128):
    return (n + size - 1) // size


def draw(layers, textures, offsets, spread, counts, H, W, samples, seed):
    B, V = offsets.shape[:2]
    out = torch.zeros(B, V, 3, H, W, device=layers.device)
    offsets, spread = offsets.float().contiguous(), spread.expand(B, V).float().contiguous()
    call('draw', (blocks(H * W), V, B), (128,), layers, layers.shape[1], textures, textures.shape[1],
         offsets, spread, counts, out, V, H, W, samples, seed)
    return out


def truth(layers, H, W, samples):
    B = len(layers)
    out = torch.empty(B, H, W, samples * samples, device=layers.device)
    call('truth', (blocks(H * W), 1, B), (128,), layers, layers.shape[1], out, H, W, samples)
    return out


def pack(images, dtype=torch.half):
    """B V 3 H W in [0, 1] -> B V H W 8: colour, two gradients of grey, zeros."""
    B, V, _, H, W = images.shape
    images = images.float().contiguous()
    out = torch.empty(B, V, H, W, 8, device=images.device, dtype=dtype)
    call('pack_half' if dtype == torch.half else 'pack_float', (blocks(H * W), B * V, 1), (128,),
         images, out, H, W)
    return out


def evidence(packed, labels, table, offsets, margin, narrow):
    """B 16 D H W at labels B D or B D H W; bfloat16 where narrow, else float; innermost: channels."""
    B, V, FH, FW, _ = packed.shape
    H, W, D, cap = FH - 2 * margin, FW - 2 * margin, labels.shape[1], table.shape[2]
    labels = labels.float().contiguous()
    out = torch.empty(B, D, H, W, 16, device=packed.device,
                      dtype=torch.bfloat16 if narrow else torch.float)
    sb, sd, sp = (D, 1, 0) if labels.dim() == 2 else (D * H * W, H * W, 1)
    kind = {(torch.half, True): 'half', (torch.half, False): 'mixed', (torch.float, False): 'float'}
    call('evidence_' + kind[packed.dtype, narrow], (blocks(H * W), D, B), (128,), packed, labels, out,
         table, offsets, V, H, W, D, margin, cap, sb, sd, sp)
    return out.permute(0, 4, 1, 2, 3)
