// SPDX-License-Identifier: BSD-3-Clause
//
// Draws procedural light fields and measures evidence. Compiled at run time for the GPU; with
// HOST defined it is plain C++, so that the generator can be looked at without a GPU.

#ifndef HOST
#include <cuda_fp16.h>
#define FUNCTION __device__ __forceinline__
#endif

// One layer is a bounded surface whose disparity is a plane, a bump and a wave.
enum Parameter {
  A, BX, BY, CX, CY, SX, SY, COS, SIN, BOX, AMPLITUDE, FREQUENCY, PHASE, BUMP, ROUND, PERIOD,
  WAVE, WAVE_X, WAVE_Y, WAVE_PHASE, LIMB, POWER, TEXTURE, TEXTURE_C, TEXTURE_S, TEXTURE_X,
  TEXTURE_Y, RED, GREEN, BLUE, MIX,  // MIX: 9 numbers
  SHADOW = MIX + 9, SOFT, SHADOW_X, SHADOW_Y, SHINE, SHINE_WIDTH, SHINE_DEPTH, SHINE_X, SHINE_Y,
  RADIUS, SLACK, LAMBERT, RELIEF, LIGHT_X, LIGHT_Y, PARAMETERS = 54
};

struct Hit {
  float d, x, y, rho;
  int k;
};

FUNCTION float rho_at(const float* q, float u0, float v0, float* ex, float* ey) {
  float lx = q[COS] * u0 + q[SIN] * v0, ly = -q[SIN] * u0 + q[COS] * v0;
  if (q[PERIOD] < 1e5f) lx = lx - floorf(lx / q[PERIOD] + .5f) * q[PERIOD];
  *ex = lx / q[SX];
  *ey = ly / q[SY];
  return q[BOX] > .5f ? fmaxf(fabsf(*ex), fabsf(*ey)) : sqrtf(*ex * *ex + *ey * *ey);
}

FUNCTION float edge_at(const float* q, float ex, float ey) {
  return q[AMPLITUDE] == 0 ? 1.f
                           : 1 + q[AMPLITUDE] * cosf(q[FREQUENCY] * atan2f(ey, ex + 1e-6f) + q[PHASE]);
}

FUNCTION float disparity_at(const float* q, float u0, float v0, float ex, float ey) {
  float d = q[A] + q[BX] * u0 + q[BY] * v0;
  if (q[BUMP] != 0) {
    float e = fmaxf(1 - ex * ex - ey * ey, 0.f);
    d += q[BUMP] * (q[ROUND] > .5f ? sqrtf(fmaxf(e, .02f)) : e);
  }
  if (q[WAVE] != 0) d += q[WAVE] * sinf(q[WAVE_X] * u0 + q[WAVE_Y] * v0 + q[WAVE_PHASE]);
  return d;
}

// What the view at offset (dv, du) sees at (x, y): the nearest surface that the ray meets.
FUNCTION Hit trace(const float* layers, int count, float x, float y, float dv, float du) {
  Hit h = {-1e3f, 0, 0, 0, 0};
  float reach = fmaxf(fabsf(du), fabsf(dv));
  for (int k = 0; k < count; ++k) {
    const float* q = layers + k * PARAMETERS;
    float X = x + q[A] * du, Y = y + q[A] * dv;
    float r = q[RADIUS] + q[SLACK] * reach, u0 = X - q[CX], v0 = Y - q[CY];
    if (u0 * u0 + v0 * v0 > r * r) continue;
    float ex, ey, rho = rho_at(q, u0, v0, &ex, &ey), d = disparity_at(q, u0, v0, ex, ey);
    if (reach > 0) {
      for (int i = 0; i < 5; ++i) {
        X = x + d * du;
        Y = y + d * dv;
        u0 = X - q[CX];
        v0 = Y - q[CY];
        rho = rho_at(q, u0, v0, &ex, &ey);
        float next = disparity_at(q, u0, v0, ex, ey);
        bool still = fabsf(next - d) < 2e-4f;
        d = next;
        if (still) break;
      }
    }
    if (d <= h.d || rho > 1 + q[AMPLITUDE]) continue;
    float edge = edge_at(q, ex, ey);
    if (rho >= edge) continue;
    h.d = d;
    h.x = x + d * du;
    h.y = y + d * dv;
    h.rho = rho / edge;
    h.k = k;
  }
  return h;
}

FUNCTION void texel(const half* textures, int size, int index, float tx, float ty, float* out) {
  // Reflected at the border: the texture's period is twice its size.
  float period = 2.f * size;
  tx = tx - floorf(tx / period) * period;
  ty = ty - floorf(ty / period) * period;
  int x0 = (int)tx, y0 = (int)ty;
  float ax = tx - x0, ay = ty - y0;
  int x1 = x0 + 1, y1 = y0 + 1;
  int last = 2 * size - 1;
  if (x0 >= size) x0 = last - x0 < 0 ? 0 : last - x0;
  if (x1 >= size) x1 = last - x1 < 0 ? 0 : last - x1;
  if (y0 >= size) y0 = last - y0 < 0 ? 0 : last - y0;
  if (y1 >= size) y1 = last - y1 < 0 ? 0 : last - y1;
  const half* t = textures + (long long)index * size * size * 4;
  const half *t00 = t + (y0 * size + x0) * 4, *t01 = t + (y0 * size + x1) * 4;
  const half *t10 = t + (y1 * size + x0) * 4, *t11 = t + (y1 * size + x1) * 4;
  for (int c = 0; c < 3; ++c)
    out[c] = ((float)t00[c] * (1 - ax) + (float)t01[c] * ax) * (1 - ay) +
             ((float)t10[c] * (1 - ax) + (float)t11[c] * ax) * ay;
}

// Light from (LIGHT_X, LIGHT_Y, 1) on the bump and the wave, RELIEF pixels high for a disparity of 1.
FUNCTION float lambert(const float* q, float u0, float v0) {
  float ex, ey, gx = 0, gy = 0;
  rho_at(q, u0, v0, &ex, &ey);
  if (q[BUMP] != 0) {
    float e = 1 - ex * ex - ey * ey, f = -2 * q[BUMP];
    if (e <= 0) f = 0;
    if (q[ROUND] > .5f) f *= .5f / sqrtf(fmaxf(e, .02f));
    gx = f * (ex * q[COS] / q[SX] - ey * q[SIN] / q[SY]);
    gy = f * (ex * q[SIN] / q[SX] + ey * q[COS] / q[SY]);
  }
  if (q[WAVE] != 0) {
    float w = q[WAVE] * cosf(q[WAVE_X] * u0 + q[WAVE_Y] * v0 + q[WAVE_PHASE]);
    gx += w * q[WAVE_X];
    gy += w * q[WAVE_Y];
  }
  gx *= q[RELIEF];
  gy *= q[RELIEF];
  float dot = (1 - gx * q[LIGHT_X] - gy * q[LIGHT_Y]) / sqrtf(1 + gx * gx + gy * gy);
  return 1 - q[LAMBERT] + q[LAMBERT] * fminf(fmaxf(dot, 0.f), 1.6f);
}

FUNCTION void shade(const float* layers, int count, const half* textures, int size, const Hit& h,
                    float dv, float du, float* rgb) {
  const float* q = layers + h.k * PARAMETERS;
  float t[3], u0 = h.x - q[CX], v0 = h.y - q[CY];
  texel(textures, size, (int)q[TEXTURE], q[TEXTURE_C] * u0 + q[TEXTURE_S] * v0 + q[TEXTURE_X],
        -q[TEXTURE_S] * u0 + q[TEXTURE_C] * v0 + q[TEXTURE_Y], t);
  float light = 1;
  if (q[LIMB] > 0) light -= q[LIMB] * powf(fminf(h.rho, 1.f), q[POWER]);
  if (q[LAMBERT] > 0) light *= lambert(q, u0, v0);
  for (int k = 0; k < count; ++k) {
    const float* p = layers + k * PARAMETERS;
    if (p[SHADOW] == 0 || k == h.k) continue;
    float gap = p[A] + p[BX] * (h.x - p[CX]) + p[BY] * (h.y - p[CY]) - h.d;
    if (gap < .02f) continue;
    float X = h.x + p[SHADOW_X] * gap - p[CX], Y = h.y + p[SHADOW_Y] * gap - p[CY];
    float r = p[RADIUS] + p[SOFT];
    if (X * X + Y * Y > r * r) continue;
    float ex, ey, rho = rho_at(p, X, Y, &ex, &ey);
    float outside = (rho - 1) * fminf(p[SX], p[SY]) / (p[SOFT] * (.3f + gap));
    light *= 1 - p[SHADOW] / (1 + gap) * fminf(fmaxf(.5f - outside, 0.f), 1.f);
  }
  float shine = 0;
  if (q[SHINE] > 0) {
    float sx = u0 - q[SHINE_X] - q[SHINE_DEPTH] * du, sy = v0 - q[SHINE_Y] - q[SHINE_DEPTH] * dv;
    shine = q[SHINE] * expf(-(sx * sx + sy * sy) / (q[SHINE_WIDTH] * q[SHINE_WIDTH]));
  }
  for (int c = 0; c < 3; ++c) {
    const float* m = q + MIX + 3 * c;
    float value = q[RED + c] + m[0] * t[0] + m[1] * t[1] + m[2] * t[2];
    rgb[c] = fminf(fmaxf(value, 0.f), 1.f) * light + shine;
  }
}

FUNCTION float hashed(unsigned a) {
  a = (a ^ 61u) ^ (a >> 16);
  a *= 9u;
  a ^= a >> 4;
  a *= 0x27d4eb2du;
  a ^= a >> 15;
  return (a & 0xffffff) * (1.f / 16777216.f);
}

#ifndef HOST

// images: B V 3 H W; offsets: B V 2 (dv, du, as they truly are); spread: B V (size of a pixel).
extern "C" __global__ void draw(const float* layers, int count, const half* textures, int size,
                                const float* offsets, const float* spread, const int* views,
                                float* images, int V, int H, int W, int samples, int seed) {
  int p = blockIdx.x * blockDim.x + threadIdx.x, v = blockIdx.y, b = blockIdx.z;
  if (p >= H * W || v >= views[b]) return;
  int y = p / W, x = p % W;
  const float* q = layers + (long long)b * count * PARAMETERS;
  float dv = offsets[(b * V + v) * 2], du = offsets[(b * V + v) * 2 + 1], s = spread[b * V + v];
  float sum[3] = {0, 0, 0};
  unsigned key = seed + 7919u * (((unsigned)b * V + v) * H * W + p);
  float jx = hashed(key), jy = hashed(key + 1);
  for (int i = 0; i < samples; ++i)
    for (int j = 0; j < samples; ++j) {
      float px = x + .5f - W * .5f + ((j + jx) / samples - .5f) * s;
      float py = y + .5f - H * .5f + ((i + jy) / samples - .5f) * s;
      Hit h = trace(q, count, px, py, dv, du);
      float rgb[3];
      shade(q, count, textures, size, h, dv, du, rgb);
      for (int c = 0; c < 3; ++c) sum[c] += rgb[c];
    }
  for (int c = 0; c < 3; ++c)
    images[(((long long)b * V + v) * 3 + c) * H * W + p] = sum[c] / (samples * samples);
}

// truth: B H W samples*samples disparities of the reference view.
extern "C" __global__ void truth(const float* layers, int count, float* out, int H, int W,
                                 int samples) {
  int p = blockIdx.x * blockDim.x + threadIdx.x, b = blockIdx.z;
  if (p >= H * W) return;
  int y = p / W, x = p % W;
  const float* q = layers + (long long)b * count * PARAMETERS;
  for (int i = 0; i < samples; ++i)
    for (int j = 0; j < samples; ++j) {
      float px = x + (j + .5f) / samples - W * .5f, py = y + (i + .5f) / samples - H * .5f;
      out[(((long long)b * H * W + p) * samples + i) * samples + j] =
          trace(q, count, px, py, 0, 0).d;
    }
}

// packed: B V H W 8: R, G, B, the differences of grey to the right and downwards, 0 0 0.
template <typename T> FUNCTION void pack_pixel(const float* images, T* packed, int n, int H, int W) {
  int p = blockIdx.x * blockDim.x + threadIdx.x;
  if (p >= H * W) return;
  const float* im = images + (long long)n * 3 * H * W;
  int y = p / W, x = p % W, N = H * W;
  auto grey = [&](int yy, int xx) {
    int i = yy * W + xx;
    return (im[i] + im[N + i] + im[2 * N + i]) * (1.f / 3);
  };
  T* o = packed + ((long long)n * N + p) * 8;
  for (int c = 0; c < 3; ++c) o[c] = (T)im[c * N + p];
  o[3] = (T)(grey(y, min(x + 1, W - 1)) - grey(y, max(x - 1, 0)));
  o[4] = (T)(grey(min(y + 1, H - 1), x) - grey(max(y - 1, 0), x));
  o[5] = o[6] = o[7] = (T)0.f;
}
extern "C" __global__ void pack_half(const float* images, half* packed, int H, int W) {
  pack_pixel(images, packed, blockIdx.y, H, W);
}
extern "C" __global__ void pack_float(const float* images, float* packed, int H, int W) {
  pack_pixel(images, packed, blockIdx.y, H, W);
}

FUNCTION void load8(const half* p, float* o) {
  uint4 w = *(const uint4*)p;
  half2 a = *(half2*)&w.x, b = *(half2*)&w.y, c = *(half2*)&w.z;
  o[0] = __low2float(a), o[1] = __high2float(a), o[2] = __low2float(b), o[3] = __high2float(b);
  o[4] = __low2float(c);
}
FUNCTION void load8(const float* p, float* o) {
  float4 w = *(const float4*)p;
  o[0] = w.x, o[1] = w.y, o[2] = w.z, o[3] = w.w, o[4] = p[4];
}
FUNCTION unsigned bf16(float f) {
  unsigned u = __float_as_uint(f);
  return (u + 0x7fff + ((u >> 16) & 1)) >> 16;
}
FUNCTION void store16(unsigned short* o, const float* e) {
  unsigned w[8];
  for (int i = 0; i < 8; ++i) w[i] = bf16(e[2 * i]) | bf16(e[2 * i + 1]) << 16;
  ((uint4*)o)[0] = make_uint4(w[0], w[1], w[2], w[3]);
  ((uint4*)o)[1] = make_uint4(w[4], w[5], w[6], w[7]);
}
FUNCTION void store16(float* o, const float* e) {
  for (int i = 0; i < 16; ++i) o[i] = e[i];
}

// out: B D H W 16 over the middle H W pixels of pictures that are `margin` larger on each side.
// labels: one number per (b, d) or one per (b, d, pixel): strides sb, sd, sp.
// table: B 8 cap indices of views, -1 where there are none; offsets: B V 2 as promised.
template <typename T, typename O>
FUNCTION void evidence_pixel(const T* images, const float* labels, O* out, const int* table,
                             const float* offsets, int V, int H, int W, int D, int margin, int cap,
                             int sb, int sd, int sp) {
  int p = blockIdx.x * blockDim.x + threadIdx.x, d = blockIdx.y, b = blockIdx.z;
  if (p >= H * W) return;
  int y = p / W + margin, x = p % W + margin, FW = W + 2 * margin, FH = H + 2 * margin;
  float l = labels[(long long)b * sb + (long long)d * sd + (long long)p * sp];
  const T* base = images + (long long)b * V * FH * FW * 8;
  float c[5], e[16];
  load8(base + ((long long)y * FW + x) * 8, c);
#pragma unroll
  for (int k = 0; k < 8; ++k) {
    float rgb = 0, gradient = 0, n = 0;
    for (int j = 0; j < cap; ++j) {
      int v = table[(b * 8 + k) * cap + j];
      if (v < 0) break;
      float fy = y - l * offsets[(b * V + v) * 2], fx = x - l * offsets[(b * V + v) * 2 + 1];
      if (!(fx >= 0 && fx <= FW - 1 && fy >= 0 && fy <= FH - 1)) continue;
      int x0 = (int)fx, y0 = (int)fy;
      float ax = fx - x0, ay = fy - y0;
      int x1 = min(x0 + 1, FW - 1), y1 = min(y0 + 1, FH - 1);
      const T* q = base + (long long)v * FH * FW * 8;
      float s00[5], s01[5], s10[5], s11[5], w00 = (1 - ay) * (1 - ax), w01 = (1 - ay) * ax;
      float w10 = ay * (1 - ax), w11 = ay * ax;
      load8(q + (y0 * FW + x0) * 8, s00);
      load8(q + (y0 * FW + x1) * 8, s01);
      load8(q + (y1 * FW + x0) * 8, s10);
      load8(q + (y1 * FW + x1) * 8, s11);
      float a[5];
#pragma unroll
      for (int i = 0; i < 5; ++i)
        a[i] = fabsf(s00[i] * w00 + s01[i] * w01 + s10[i] * w10 + s11[i] * w11 - c[i]);
      rgb += a[0] + a[1] + a[2];
      gradient += a[3] + a[4];
      n += 1;
    }
    e[k] = n > 0 ? (logf(rgb / n / 3 + .003f) + 4.2f) * .8f : 1.5f;
    e[8 + k] = n > 0 ? (logf(gradient / n / 2 + .003f) + 4.2f) * .8f : 1.5f;
  }
  store16(out + ((((long long)b * D + d) * H * W) + p) * 16, e);
}
extern "C" __global__ void evidence_half(const half* i, const float* l, unsigned short* o,
                                         const int* t, const float* f, int V, int H, int W, int D,
                                         int margin, int cap, int sb, int sd, int sp) {
  evidence_pixel(i, l, o, t, f, V, H, W, D, margin, cap, sb, sd, sp);
}
extern "C" __global__ void evidence_mixed(const half* i, const float* l, float* o, const int* t,
                                          const float* f, int V, int H, int W, int D, int margin,
                                          int cap, int sb, int sd, int sp) {
  evidence_pixel(i, l, o, t, f, V, H, W, D, margin, cap, sb, sd, sp);
}
extern "C" __global__ void evidence_float(const float* i, const float* l, float* o, const int* t,
                                          const float* f, int V, int H, int W, int D, int margin,
                                          int cap, int sb, int sd, int sp) {
  evidence_pixel(i, l, o, t, f, V, H, W, D, margin, cap, sb, sd, sp);
}
#endif
