// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/net_layers.h"
#include "engine/core/error.h"
#include "tests/engine/disparity/net/net_vectors.h"
#include "tests/test_main.h"

#include <cmath>
#include <random>

namespace episcope::in_net_layers_test {

using namespace episcope::test;

namespace {

// Weights have half precision, sums of up to 1728 products are made in another order: 2⁻²⁴ of the
// largest partial sum (about 10) for each doubling of their number.
constexpr double kTolerance = 2e-5;

std::size_t place(const NetShape& shape, int c, int z, int y, int x) {
  return ((static_cast<std::size_t>(c) * shape.depth + z) * shape.height + y) * shape.width + x;
}

NetShape shape_of(const NetVector& vector) {
  const bool is_volume = vector.shape.size() == 4;
  const int rows = is_volume ? 2 : 1;
  return {vector.length(0), is_volume ? vector.length(1) : 1, vector.length(rows),
          vector.length(rows + 1)};
}

// A source of values `[c][z][y][x]`.
int add_values(NetStream& stream, const NetShape& shape, const std::vector<float>& values) {
  return stream.add_source(shape, [shape, &values](int y, int z, NetRows& rows) {
    for (int x = 0; x < shape.width; ++x) {
      for (int c = 0; c < shape.channels; ++c) {
        rows.at(y, z)[x * rows.step() + c] = values[place(shape, c, z, y, x)];
      }
    }
  });
}

std::vector<float> result(NetStream& stream, int node, int band, const Progress& progress) {
  const NetShape shape = stream.shape(node);
  std::vector<float> values(place(shape, shape.channels, 0, 0, 0));
  const auto take = [&](int y, const NetRows& rows) {
    for (int z = 0; z < shape.depth; ++z) {
      for (int x = 0; x < shape.width; ++x) {
        for (int c = 0; c < shape.channels; ++c) {
          values[place(shape, c, z, y, x)] = rows.at(y, z)[x * rows.step() + c];
        }
      }
    }
  };
  stream.run(node, band, take, progress);
  return values;
}

std::vector<float> random_numbers(std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> any(-1, 1);
  std::vector<float> values(count);
  for (float& value : values) value = any(random);
  return values;
}

std::vector<float> random_values(const NetShape& shape) {
  return random_numbers(place(shape, shape.channels, 0, 0, 0));
}

// Sums of 513 products in [-1, 1], made in float one by one, are off by up to 2.4e-5; those of
// mixed numbers by twice as much on average and 3.3e-5 at most.
constexpr double kMixedTolerance = 5e-5;

// What a convolution of stride 1 without a leaky ReLU gives at a place, summed in double.
double plain_sum(const NetLayerForm& form, const NetShape& shape, const std::vector<float>& values,
                 const std::vector<float>& weights, int output, int z, int y, int x) {
  double sum = 0;
  std::size_t weight = static_cast<std::size_t>(output) * form.inputs * form.taps();
  for (int c = 0; c < form.inputs; ++c) {
    for (int tap = 0; tap < form.taps(); ++tap, ++weight) {
      const int from_z = z + (form.dimensions == 3 ? tap / 9 - 1 : 0) * form.dilation;
      const int from_y = y + (tap / 3 % 3 - 1) * form.dilation;
      const int from_x = x + (tap % 3 - 1) * form.dilation;
      const bool is_within = from_z >= 0 && from_z < shape.depth && from_y >= 0 &&
                             from_y < shape.height && from_x >= 0 && from_x < shape.width;
      if (!is_within) continue;
      sum += static_cast<double>(weights[weight]) * values[place(shape, c, from_z, from_y, from_x)];
    }
  }
  return sum;
}

// A network of every kind of layer: two levels down, with dilation, and up again.
std::vector<float> small_network(const NetShape& shape, int band, const Progress& progress) {
  const std::vector<float> values = random_values(shape);
  const NetWeights& weights = released_weights();
  NetStream stream;
  int node = add_values(stream, shape, values);
  const int x0 = stream.add_convolution(weights.layer("refinement.0.i.1"), node);
  node = stream.add_convolution(weights.layer("refinement.0.d1.0"), x0);
  node = stream.add_convolution(weights.layer("refinement.0.d1.3"), node);
  node = stream.add_convolution(weights.layer("refinement.0.u0"), node);
  node = stream.add_enlarged(node, x0);
  node = stream.add_convolution(weights.layer("refinement.0.f0.1"), node, {-1, x0});
  return result(stream, stream.add_convolution(weights.layer("refinement.0.head"), node), band,
                progress);
}

}  // namespace

class NetLayersTest : public QObject {
  Q_OBJECT

 private slots:
  void convolutions_areThoseOfTheVectors_data();
  void convolutions_areThoseOfTheVectors();
  void mixedConvolution_isThePlainSum_data();
  void mixedConvolution_isThePlainSum();
  void enlarged_isThatOfTheVectors_data();
  void enlarged_isThatOfTheVectors();
  void network_isTheSameForEveryBandAndThread();
  void columns_doNotDependOnTheWidth();
  void memory_growsWithTheWidthAlone();
  void stop_isHonoured();
};

void NetLayersTest::convolutions_areThoseOfTheVectors_data() {
  QTest::addColumn<QString>("name");
  for (const char* const name : {"volume.e0", "volume.d1", "volume.u2", "selection.d1.0",
                                 "refinement.0.d1.3", "refinement.1.head"}) {
    QTest::newRow(name) << QString(name);
  }
}

void NetLayersTest::convolutions_areThoseOfTheVectors() {
  QFETCH(const QString, name);
  const std::string layer = name.toStdString();
  const NetVector in = net_vector("in " + layer), out = net_vector("out " + layer);
  NetStream stream;
  const int source = add_values(stream, shape_of(in), in.values);
  const int node = stream.add_convolution(released_weights().layer(layer), source);

  const std::vector<float> values = result(stream, node, 2, Progress());

  QVERIFY(largest_difference(values, out.values) < kTolerance);
}

void NetLayersTest::mixedConvolution_isThePlainSum_data() {
  QTest::addColumn<int>("dimensions");
  QTest::addColumn<int>("dilation");
  QTest::addColumn<int>("depth");
  QTest::addColumn<int>("height");
  QTest::addColumn<int>("width");
  QTest::newRow("volume") << 3 << 1 << 8 << 3 << 12;
  QTest::newRow("volume of odd sizes") << 3 << 1 << 6 << 3 << 101;
  QTest::newRow("map") << 2 << 1 << 1 << 8 << 16;
  QTest::newRow("map of odd sizes") << 2 << 1 << 1 << 7 << 99;
  QTest::newRow("map of one pixel") << 2 << 1 << 1 << 1 << 1;
  QTest::newRow("dilated map") << 2 << 2 << 1 << 6 << 37;
  QTest::newRow("small dilated map") << 2 << 4 << 1 << 5 << 3;
}

void NetLayersTest::mixedConvolution_isThePlainSum() {
  QFETCH(const int, dimensions);
  QFETCH(const int, dilation);
  QFETCH(const int, depth);
  QFETCH(const int, height);
  QFETCH(const int, width);
  const NetLayerForm form{"", dimensions, 19, 35, 3, 1, dilation, false, false};
  const std::vector<float> weights =
      random_numbers(static_cast<std::size_t>(form.outputs) * form.inputs * form.taps());
  const NetLayer layer = make_net_layer(form, weights, {});
  const NetShape shape{form.inputs, depth, height, width};
  const std::vector<float> values = random_values(shape);
  NetStream stream;
  const int node = stream.add_convolution(layer, add_values(stream, shape, values));

  const std::vector<float> found = result(stream, node, 3, Progress());

  QVERIFY(form.is_mixed());
  const NetShape out = stream.shape(node);
  for (int c = 0; c < out.channels; ++c) {
    for (int i = 0; i < depth * height * width; ++i) {
      const int z = i / (height * width), y = i / width % height, x = i % width;
      const double expected = plain_sum(form, shape, values, weights, c, z, y, x);
      QVERIFY(std::abs(found[place(out, c, z, y, x)] - expected) < kMixedTolerance);
    }
  }
}

void NetLayersTest::enlarged_isThatOfTheVectors_data() {
  QTest::addColumn<QString>("name");
  for (const char* const name : {"up2", "up3"}) QTest::newRow(name) << QString(name);
}

void NetLayersTest::enlarged_isThatOfTheVectors() {
  QFETCH(const QString, name);
  const NetVector in = net_vector("in " + name.toStdString());
  const NetVector out = net_vector("out " + name.toStdString());
  const std::vector<float> zeros(out.values.size());
  NetStream stream;
  const int source = add_values(stream, shape_of(in), in.values);
  const int plus = add_values(stream, shape_of(out), zeros);
  const int node = stream.add_enlarged(source, plus);

  const std::vector<float> values = result(stream, node, 2, Progress());

  // Weights are multiples of 1/64, of numbers of about 1.
  QVERIFY(largest_difference(values, out.values) < 1e-6);
}

void NetLayersTest::network_isTheSameForEveryBandAndThread() {
  const NetShape shape{48, 1, 37, 29};
  const std::vector<float> whole = small_network(shape, 64, Progress(1));

  for (const int band : {1, 2, 7, 16}) {
    QVERIFY(small_network(shape, band, Progress(1)) == whole);
    QVERIFY(small_network(shape, band, Progress(3)) == whole);
  }
}

void NetLayersTest::columns_doNotDependOnTheWidth() {
  const NetLayer& layer = released_weights().layer("refinement.0.i.1");
  const NetShape wide{48, 1, 5, 31}, narrow{48, 1, 5, 19};
  const std::vector<float> values = random_values(wide);
  std::vector<float> cut(place(narrow, 48, 0, 0, 0));
  const auto cut_out = [&](const std::vector<float>& from, std::vector<float>& to) {
    for (int c = 0; c < 48; ++c) {
      for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 19; ++x) to[place(narrow, c, 0, y, x)] = from[place(wide, c, 0, y, x)];
      }
    }
  };
  cut_out(values, cut);
  NetStream all, part;
  const int all_node = all.add_convolution(layer, add_values(all, wide, values));
  const int part_node = part.add_convolution(layer, add_values(part, narrow, cut));

  std::vector<float> expected(cut.size());
  cut_out(result(all, all_node, 2, Progress()), expected);
  const std::vector<float> found = result(part, part_node, 2, Progress());

  for (int c = 0; c < 48; ++c) {
    for (int y = 0; y < 5; ++y) {
      // The last columns are mixed with what was cut.
      for (int x = 0; x < 19 / kNetTile * kNetTile; ++x) {
        QCOMPARE(found[place(narrow, c, 0, y, x)], expected[place(narrow, c, 0, y, x)]);
      }
    }
  }
}

void NetLayersTest::memory_growsWithTheWidthAlone() {
  const auto bytes = [](int height) {
    NetStream stream;
    const int source = stream.add_source({48, 1, height, 40}, [](int, int, NetRows&) {});
    const NetWeights& weights = released_weights();
    const int node = stream.add_convolution(weights.layer("refinement.0.i.1"), source);
    return stream.bytes(stream.add_convolution(weights.layer("refinement.0.d1.0"), node), 16);
  };

  QCOMPARE(bytes(1000), bytes(500));
  QVERIFY(bytes(500) < 500 * 40 * 48 * 4);
}

void NetLayersTest::stop_isHonoured() {
  std::stop_source stop;
  stop.request_stop();

  QVERIFY_THROWS_EXCEPTION(
      Cancelled, (void)small_network({48, 1, 37, 29}, 4, Progress(stop.get_token(), {}, 2)));
}

}  // namespace episcope::in_net_layers_test

EPISCOPE_TEST(net_layers_test, NetLayersTest)
#include "net_layers_test.moc"
