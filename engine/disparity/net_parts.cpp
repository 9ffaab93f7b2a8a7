// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/net_parts.h"

#include <array>
#include <initializer_list>

namespace episcope {

namespace {

// Layers one after the other.
int add_chain(NetStream& stream, const NetWeights& weights, int input,
              std::initializer_list<std::string> names) {
  for (const std::string& name : names) {
    input = stream.add_convolution(weights.layer(name), input);
  }
  return input;
}

// A tensor plus two layers of it.
int add_residual(NetStream& stream, const NetWeights& weights, int input, const std::string& name) {
  const int first = stream.add_convolution(weights.layer(name + ".0"), input);
  return stream.add_convolution(weights.layer(name + ".1"), first, {-1, input});
}

// A layer of 1×1, then its output twice as large plus another, then a layer of it.
int add_ascent(NetStream& stream, const NetWeights& weights, int input, int plus,
               const std::array<std::string, 2>& names) {
  const int reduced = stream.add_convolution(weights.layer(names[0]), input);
  const int sum = stream.add_enlarged(reduced, plus);
  return stream.add_convolution(weights.layer(names[1]), sum);
}

cuda::NetConvolution convolution_of(const NetLayer& layer) {
  const NetLayerForm& form = layer.form;
  return {.inputs = form.inputs,
          .outputs = form.outputs,
          .kernel = form.kernel,
          .depth_taps = form.depth_taps(),
          .stride = form.stride,
          .dilation = form.dilation,
          .is_leaky = form.is_leaky,
          .weights = layer.plain_weights,
          .bias = std::vector<float>(layer.bias_data(), layer.bias_data() + form.outputs)};
}

cuda::NetPart steps_of(const NetStream& stream) {
  cuda::NetPart part;
  for (const NetOperation& operation : stream.operations()) {
    part.push_back({.convolution = {},
                    .input = operation.input,
                    .before = operation.sums.before,
                    .after = operation.sums.after});
    if (operation.layer != nullptr) part.back().convolution = convolution_of(*operation.layer);
  }
  return part;
}

// A source that is only connected.
int add_unfilled(NetStream& stream, int channels, int depth = 1) {
  return stream.add_source({channels, depth, 1, 1}, {});
}

cuda::NetReduction reduction_of(const NetWeights& weights, const std::string& name) {
  return {convolution_of(weights.layer(name + "reduce.a")),
          convolution_of(weights.layer(name + "reduce.b"))};
}

}  // namespace

std::string net_refinement(int number) {
  return "refinement." + std::to_string(number) + ".";
}

int add_net_volume(NetStream& stream, const NetWeights& weights, int evidence, int guide) {
  const std::string v = "volume.";
  const int map = add_chain(stream, weights, guide, {v + "image.0", v + "image.1", v + "image.2"});
  const int input = stream.add_convolution(weights.layer(v + "input"), evidence, {map, -1});
  const int x0 = stream.add_convolution(weights.layer(v + "e0"), input, {-1, input});
  const int x1 = add_chain(stream, weights, x0, {v + "d1", v + "e1"});
  const int e2 = add_chain(stream, weights, x1, {v + "d2", v + "e2.0", v + "e2.1"});
  const int x2 = add_residual(stream, weights, e2, v + "r2");
  const int e3 = add_chain(stream, weights, x2, {v + "d3", v + "e3.0", v + "e3.1"});
  const int x3 = add_residual(stream, weights, e3, v + "r3");
  const int f2 = add_ascent(stream, weights, x3, x2, {v + "u2", v + "f2"});
  const int y2 = add_residual(stream, weights, f2, v + "s2");
  const int y1 = add_ascent(stream, weights, y2, x1, {v + "u1", v + "f1"});
  const int y0 = add_ascent(stream, weights, y1, x0, {v + "u0", v + "f0"});
  return stream.add_convolution(weights.layer(v + "head"), y0);
}

int add_net_selection(NetStream& stream, const NetWeights& weights, int input) {
  const std::string s = kNetSelection;
  const int i = add_chain(stream, weights, input, {s + "i.0", s + "i.1"});
  const int x0 = add_residual(stream, weights, i, s + "r0");
  const int d1 = add_chain(stream, weights, x0, {s + "d1.0", s + "d1.1"});
  const int x1 = add_residual(stream, weights, d1, s + "r1");
  const int d2 = add_chain(stream, weights, x1, {s + "d2.0", s + "d2.1", s + "d2.2", s + "d2.3"});
  const int d3 = add_chain(stream, weights, d2, {s + "d3.0", s + "d3.1", s + "d3.2", s + "u2"});
  const int x2 = stream.add_enlarged(d3, d2);
  const int f1 = add_ascent(stream, weights, x2, x1, {s + "u1", s + "f1"});
  const int y1 = add_residual(stream, weights, f1, s + "s1");
  const int y0 = add_ascent(stream, weights, y1, x0, {s + "u0", s + "f0"});
  return stream.add_convolution(weights.layer(s + "head"), y0);
}

int add_net_refinement(NetStream& stream, const NetWeights& weights, int input, int number) {
  const std::string r = net_refinement(number);
  const int i = add_chain(stream, weights, input, {r + "i.0", r + "i.1"});
  const int x0 = add_residual(stream, weights, i, r + "r0");
  const int d1 = add_chain(stream, weights, x0, {r + "d1.0", r + "d1.1", r + "d1.2", r + "d1.3"});
  const int x1 = add_residual(stream, weights, d1, r + "r1");
  const int y = stream.add_convolution(weights.layer(r + "u0"), x1);
  return add_chain(stream, weights, stream.add_enlarged(y, x0),
                   {r + "f0.0", r + "f0.1", r + "head"});
}

cuda::NetParts net_parts(const NetWeights& weights) {
  cuda::NetParts parts;
  NetStream volume, selection;
  constexpr int kLabels = 8;  // Of any number that is a multiple.
  const int evidence = add_unfilled(volume, kNetEvidence, kLabels);
  static_cast<void>(add_net_volume(volume, weights, evidence, add_unfilled(volume, kNetGuide)));
  parts.volume = steps_of(volume);
  static_cast<void>(
      add_net_selection(selection, weights, add_unfilled(selection, kNetSelectionInputs)));
  parts.selection = steps_of(selection);
  parts.selection_reduction = reduction_of(weights, kNetSelection);
  for (int i = 0; i < kNetRefinements; ++i) {
    NetStream refinement;
    static_cast<void>(
        add_net_refinement(refinement, weights, add_unfilled(refinement, kNetRefinementInputs), i));
    parts.refinements[i] = steps_of(refinement);
    parts.refinement_reductions[i] = reduction_of(weights, net_refinement(i));
  }
  return parts;
}

}  // namespace episcope
