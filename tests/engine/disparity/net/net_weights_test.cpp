// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/net_weights.h"
#include "engine/core/error.h"
#include "tests/engine/disparity/net/net_vectors.h"
#include "tests/test_main.h"

#include <QFile>
#include <QTemporaryDir>

namespace episcope::in_net_weights_test {

using namespace episcope::test;

namespace {

NamedArrays released() {
  return read_named_arrays(released_weights_path());
}

QByteArray released_bytes() {
  QFile file(QString::fromStdString(released_weights_path()));
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

// The sentence that reading and checking such a file gives; empty if there is none.
std::string failure_of(const QByteArray& bytes) {
  const QTemporaryDir folder;
  QFile file(folder.filePath("net.npz"));
  if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size()) return "not written";
  file.close();
  try {
    (void)NetWeights(read_named_arrays(file.fileName().toStdString()));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

class NetWeightsTest : public QObject {
  Q_OBJECT

 private slots:
  void release_isRead();
  void narrowLayers_haveTheirInputsSideBySide();
  void missingArray_isNamed();
  void unknownArray_isNamed();
  void otherShape_isStated();
  void truncatedFiles_areRefused();
  void otherNumbers_areRefused();
  void absurdSizes_areRefused();
  void changedNumber_isRefused();
  void compressedFiles_areRefused();
  void otherFiles_areRefused();
  void release_isInstalled();
};

void NetWeightsTest::release_isRead() {
  const NamedArrays arrays = released();

  const NetWeights weights(arrays);

  QVERIFY(weights.record().find("\"name\": \"net\"") != std::string::npos);
  const NetLayer& layer = weights.layer("selection.d1.0");
  QCOMPARE(layer.form.inputs, 64);
  const auto array = std::ranges::find(arrays.arrays, "selection.d1.0.weight", &NamedArray::name);
  const auto scale = std::ranges::find(arrays.arrays, "selection.d1.0.scale", &NamedArray::name);
  // Output 17, input 3, row 2, column 1 of the kernel.
  const float value = array->values[((17 * 64 + 3) * 3 + 2) * 3 + 1] * scale->values[17];
  QCOMPARE(layer.weights_data()[layer.group_stride() + 7 * layer.tap_stride() + 3 * 16 + 1], value);
}

void NetWeightsTest::narrowLayers_haveTheirInputsSideBySide() {
  const NamedArrays arrays = released();
  const auto array = std::ranges::find(arrays.arrays, "volume.head.weight", &NamedArray::name);

  const NetLayer layer = NetWeights(arrays).layer("volume.head");

  for (int tap = 0; tap < 27; ++tap) {
    for (int i = 0; i < 16; ++i) {
      QCOMPARE(layer.weights_data()[tap * 16 + i], array->values[i * 27 + tap]);
    }
  }
}

void NetWeightsTest::missingArray_isNamed() {
  NamedArrays arrays = released();
  std::erase_if(arrays.arrays, [](const NamedArray& a) { return a.name == "volume.e0.bias"; });

  try {
    (void)NetWeights(arrays);
    QFAIL("nothing was thrown");
  } catch (const InvalidInput& error) {
    QVERIFY(QString(error.what()).contains("volume.e0.bias"));
  }
}

void NetWeightsTest::unknownArray_isNamed() {
  NamedArrays arrays = released();
  arrays.arrays.push_back({"volume.e9.weight", {1}, {0}});

  try {
    (void)NetWeights(arrays);
    QFAIL("nothing was thrown");
  } catch (const InvalidInput& error) {
    QVERIFY(QString(error.what()).contains("volume.e9.weight"));
  }
}

void NetWeightsTest::otherShape_isStated() {
  NamedArrays arrays = released();
  const auto array = std::ranges::find(arrays.arrays, "volume.u2.weight", &NamedArray::name);
  std::swap(array->shape[0], array->shape[1]);

  try {
    (void)NetWeights(arrays);
    QFAIL("nothing was thrown");
  } catch (const InvalidInput& error) {
    QVERIFY(QString(error.what()).contains("64×48×1×1×1"));
  }
}

void NetWeightsTest::truncatedFiles_areRefused() {
  const QByteArray bytes = released_bytes();
  QCOMPARE(failure_of(bytes), std::string());

  for (const qsizetype left : {0, 1, 100, 1000, 100000}) {
    QVERIFY(!failure_of(bytes.left(left)).empty());
  }
  QVERIFY(!failure_of(bytes.chopped(1)).empty());
}

void NetWeightsTest::otherNumbers_areRefused() {
  QByteArray bytes = released_bytes();
  bytes.replace("'<f2'", "'<i2'");

  QVERIFY(QString::fromStdString(failure_of(bytes)).contains("<i2"));
}

void NetWeightsTest::absurdSizes_areRefused() {
  QByteArray bytes = released_bytes();
  bytes.replace("(16, 5, 3, 3), ", "(99999999,)   ");

  QVERIFY(!failure_of(bytes).empty());
}

void NetWeightsTest::changedNumber_isRefused() {
  QByteArray bytes = released_bytes();
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);

  QVERIFY(QString::fromStdString(failure_of(bytes)).contains("damaged"));
}

void NetWeightsTest::compressedFiles_areRefused() {
  QByteArray bytes = released_bytes();
  const qsizetype entry = bytes.indexOf("PK\1\2");
  QVERIFY(entry > 0);
  bytes[entry + 10] = 8;

  QVERIFY(QString::fromStdString(failure_of(bytes)).contains("numpy.savez"));
}

void NetWeightsTest::otherFiles_areRefused() {
  QVERIFY(QString::fromStdString(failure_of("some text")).contains("choose a file of weights"));
  for (const char* path : {"", "/", "/nowhere.npz"}) {
    QVERIFY_THROWS_EXCEPTION(IoError, (void)read_named_arrays(path));
  }
}

void NetWeightsTest::release_isInstalled() {
  QCOMPARE(read_named_arrays(installed_weights("net.npz")).hash, released().hash);
  QVERIFY_THROWS_EXCEPTION(Unavailable, (void)installed_weights("none.npz"));
}

}  // namespace episcope::in_net_weights_test

EPISCOPE_TEST(net_weights_test, NetWeightsTest)
#include "net_weights_test.moc"
