// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/net.h"
#include "tests/engine/disparity/net/net_vectors.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace episcope::in_net_parts_test {

using namespace episcope::test;

namespace {

// Layers round sums of up to 1728 products; see net_layers_test.
constexpr double kTolerance = 2e-4;
constexpr int kBand = 4;  // Rows: fewer than any tensor has.

struct PlainTensor {
  NetShape shape;
  std::vector<double> values;  // `[c][z][y][x]`

  explicit PlainTensor(NetShape size)
      : shape(size),
        values(static_cast<std::size_t>(size.channels) * size.depth * size.height * size.width) {}
  [[nodiscard]] std::size_t place(int c, int z, int y, int x) const {
    return ((static_cast<std::size_t>(c) * shape.depth + z) * shape.height + y) * shape.width + x;
  }
  [[nodiscard]] double at(int c, int z, int y, int x) const {
    const bool is_within =
        z >= 0 && z < shape.depth && y >= 0 && y < shape.height && x >= 0 && x < shape.width;
    return is_within ? values[place(c, z, y, x)] : 0;
  }
  template <class Value>
  void fill(const Value& value) {
    for (int c = 0; c < shape.channels; ++c) {
      for (int z = 0; z < shape.depth; ++z) {
        for (int y = 0; y < shape.height; ++y) {
          for (int x = 0; x < shape.width; ++x) values[place(c, z, y, x)] = value(c, z, y, x);
        }
      }
    }
  }
};

double sum_at(const cuda::NetConvolution& form, const PlainTensor& from, int c, int z, int y,
              int x) {
  const int half = form.kernel / 2, depth_half = form.depth_taps / 2;
  const int depth_stride = form.depth_taps > 1 ? form.stride : 1;
  std::size_t weight =
      static_cast<std::size_t>(c) * form.inputs * form.depth_taps * form.kernel * form.kernel;
  double sum = form.bias[c];
  for (int input = 0; input < form.inputs; ++input) {
    for (int k = -depth_half; k <= depth_half; ++k) {
      for (int i = -half; i <= half; ++i) {
        for (int j = -half; j <= half; ++j) {
          sum += static_cast<double>(form.weights[weight++]) *
                 from.at(input, z * depth_stride + k, y * form.stride + i * form.dilation,
                         x * form.stride + j * form.dilation);
        }
      }
    }
  }
  return sum;
}

NetShape shape_of(const cuda::NetConvolution& form, const NetShape& from) {
  const auto halved = [&](int extent) { return (extent - 1) / form.stride + 1; };
  return {form.outputs, form.depth_taps > 1 ? halved(from.depth) : from.depth, halved(from.height),
          halved(from.width)};
}

// Twice as large along each axis: 3/4 of the near place, 1/4 of the one behind or before.
double enlarged_at(const PlainTensor& from, int c, int z, int y, int x, bool is_map) {
  const auto far = [](int place, int extent) {
    return std::clamp(place / 2 + (place % 2 == 0 ? -1 : 1), 0, extent - 1);
  };
  const int rows[2] = {y / 2, far(y, from.shape.height)};
  const int columns[2] = {x / 2, far(x, from.shape.width)};
  const int labels[2] = {is_map ? 0 : z / 2, is_map ? 0 : far(z, from.shape.depth)};
  double sum = 0;
  for (int i = 0; i < 8; ++i) {
    const double weight = (i & 1 ? 0.25 : 0.75) * (i & 2 ? 0.25 : 0.75) * (i & 4 ? 0.25 : 0.75);
    sum += weight * from.at(c, labels[i >> 2], rows[i >> 1 & 1], columns[i & 1]);
  }
  return sum;
}

// The steps of a part, in double.
PlainTensor run(const cuda::NetPart& part, const std::vector<PlainTensor>& sources) {
  std::vector<PlainTensor> tensors;
  auto source = sources.begin();
  for (const cuda::NetStep& step : part) {
    const cuda::NetConvolution& form = step.convolution;
    if (step.input < 0) {
      tensors.push_back(*source++);
      continue;
    }
    const PlainTensor& from = tensors[step.input];
    PlainTensor out(form.kernel > 0 ? shape_of(form, from.shape) : tensors[step.after].shape);
    out.fill([&](int c, int z, int y, int x) {
      double value = form.kernel > 0 ? sum_at(form, from, c, z, y, x)
                                     : enlarged_at(from, c, z, y, x, out.shape.depth == 1);
      if (step.before >= 0) {
        const PlainTensor& before = tensors[step.before];
        value += before.at(c, before.shape.depth == 1 ? 0 : z, y, x);
      }
      if (form.is_leaky || step.before >= 0) value = std::max(value, kNetLeak * value);
      return step.after < 0 ? value : value + tensors[step.after].at(c, z, y, x);
    });
    tensors.push_back(std::move(out));
  }
  return tensors.back();
}

PlainTensor random_tensor(NetShape shape) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> any(-1, 1);
  PlainTensor tensor(shape);
  for (double& value : tensor.values) value = any(random);
  return tensor;
}

int add_tensor(NetStream& stream, const PlainTensor& tensor) {
  return stream.add_source(tensor.shape, [&tensor](int y, int z, NetRows& rows) {
    for (int x = 0; x < tensor.shape.width; ++x) {
      for (int c = 0; c < tensor.shape.channels; ++c) {
        rows.at(y, z)[x * rows.step() + c] = static_cast<float>(tensor.at(c, z, y, x));
      }
    }
  });
}

// The largest difference between what a stream computes and the steps' result.
double difference(NetStream& stream, int node, const PlainTensor& expected) {
  double largest = 0;
  stream.run(
      node, kBand,
      [&](int y, const NetRows& rows) {
        for (int z = 0; z < expected.shape.depth; ++z) {
          for (int x = 0; x < expected.shape.width; ++x) {
            for (int c = 0; c < expected.shape.channels; ++c) {
              const double off = rows.at(y, z)[x * rows.step() + c] - expected.at(c, z, y, x);
              if (!(std::abs(off) <= largest)) largest = std::abs(off);
            }
          }
        }
      },
      Progress(1));
  return largest;
}

}  // namespace

/// What the device is told of the network is the network that the CPU runs.
class NetPartsTest : public QObject {
  Q_OBJECT

 private slots:
  void volume_isThatOfTheCpu();
  void selection_isThatOfTheCpu();
  void refinements_areThoseOfTheCpu();
  void reductions_areTheLayers();
};

void NetPartsTest::volume_isThatOfTheCpu() {
  const PlainTensor evidence = random_tensor({kNetEvidence, 8, 9, 7});
  const PlainTensor guide = random_tensor({kNetGuide, 1, 9, 7});
  NetStream stream;
  const int source = add_tensor(stream, evidence);
  const int node = add_net_volume(stream, released_weights(), source, add_tensor(stream, guide));

  const PlainTensor found = run(net_parts(released_weights()).volume, {evidence, guide});

  QCOMPARE(found.shape.depth, 8);
  QVERIFY(difference(stream, node, found) < kTolerance);
}

void NetPartsTest::selection_isThatOfTheCpu() {
  const PlainTensor input = random_tensor({kNetSelectionInputs, 1, 17, 20});
  NetStream stream;
  const int node = add_net_selection(stream, released_weights(), add_tensor(stream, input));

  const PlainTensor found = run(net_parts(released_weights()).selection, {input});

  QCOMPARE(found.shape.channels, kNetHypotheses);
  QVERIFY(difference(stream, node, found) < kTolerance);
}

void NetPartsTest::refinements_areThoseOfTheCpu() {
  const PlainTensor input = random_tensor({kNetRefinementInputs, 1, 9, 7});
  for (int i = 0; i < kNetRefinements; ++i) {
    NetStream stream;
    const int node = add_net_refinement(stream, released_weights(), add_tensor(stream, input), i);

    const PlainTensor found = run(net_parts(released_weights()).refinements[i], {input});

    QVERIFY(difference(stream, node, found) < kTolerance);
  }
}

void NetPartsTest::reductions_areTheLayers() {
  const cuda::NetParts parts = net_parts(released_weights());

  const NetLayer& layer = released_weights().layer("refinement.1.reduce.b");
  const cuda::NetConvolution& found = parts.refinement_reductions[1].second;
  QCOMPARE(found.outputs, kNetReduced);
  QVERIFY(found.weights == layer.plain_weights);
  QCOMPARE(found.weights.size(), static_cast<std::size_t>(kNetReduced * kNetEvidence));
  QCOMPARE(found.bias.size(), static_cast<std::size_t>(kNetReduced));
}

}  // namespace episcope::in_net_parts_test

EPISCOPE_TEST(net_parts_test, NetPartsTest)
#include "net_parts_test.moc"
