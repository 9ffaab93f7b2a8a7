// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/builtin.h"
#include "tests/test_main.h"

namespace episcope::in_builtin_hash_test {

namespace {

// Kinds and their seeds: every form, finish and sensor is met.
void add_random_scenes() {
  const auto add = [](const char* id, quint64 hash) { QTest::newRow(id) << id << 0.0 << hash; };
  add("random?seed=7", 0x7cccb2ad7d0bcc52ULL);
  add("random?seed=1&kind=occlusion", 0xd8f5bdb4ddb97fd9ULL);
  add("random?seed=2&kind=dark", 0x758b9a825dc92667ULL);
  add("random?seed=3&kind=thin", 0x3ca4ad121d585b7cULL);
  add("random?seed=4&kind=plain", 0x0661b543c06bf943ULL);
  add("random?seed=5&kind=periodic", 0x719bcd9423afade5ULL);
  add("random?seed=6&kind=shiny", 0xe91a8395ecd61199ULL);
  add("random?seed=7&kind=uneven", 0x3929207e676ea559ULL);
  add("random?seed=8&kind=noisy", 0x45cf11075b55b3d1ULL);
  add("random?seed=9&kind=room", 0xdbc2c158b877918bULL);
  add("random?seed=10&kind=smooth", 0x4742745831b9bb96ULL);
  add("random?seed=11&kind=aliased", 0x01ba2dd4f00942e5ULL);
}

}  // namespace

// The samples of every scene are recorded, so that any change is noticed, and every machine,
// instruction set and compiler must give the same bytes.
class BuiltinHashTest : public QObject {
  Q_OBJECT

 private slots:
  void samples_areTheRecordedOnes_data() {
    QTest::addColumn<QString>("id");
    QTest::addColumn<double>("noise");
    QTest::addColumn<quint64>("hash");
    QTest::newRow("demo") << "demo" << 0.0 << quint64{0x47c5aba5d82f20f3ULL};
    QTest::newRow("fronto") << "fronto" << 0.0 << quint64{0x3e697c8464057207ULL};
    QTest::newRow("slant") << "slant" << 0.0 << quint64{0x6add95ca1657f8a2ULL};
    QTest::newRow("edge") << "edge" << 0.0 << quint64{0x437c69eb274528dbULL};
    QTest::newRow("bars") << "bars" << 0.0 << quint64{0x25f1beb119f509c1ULL};
    QTest::newRow("objects") << "objects" << 0.0 << quint64{0x743bee42456449f5ULL};
    QTest::newRow("transparent") << "transparent" << 0.0 << quint64{0xe4efdec229f4aad7ULL};
    QTest::newRow("backgammon") << "backgammon" << 0.0 << quint64{0x4d5b1586eb483854ULL};
    QTest::newRow("dots") << "dots" << 0.0 << quint64{0xbe199dfcafe49d3bULL};
    QTest::newRow("stripes") << "stripes" << 0.0 << quint64{0x9f75664bca224cd1ULL};
    QTest::newRow("pyramids") << "pyramids" << 0.0 << quint64{0x644be5c0e40d32c2ULL};
    add_random_scenes();
    QTest::newRow("fronto, noise") << "fronto" << 5.0 << quint64{0x1198548849601a94ULL};
  }
  void samples_areTheRecordedOnes() {
    QFETCH(QString, id);
    QFETCH(double, noise);
    QFETCH(quint64, hash);
    auto [scene_id, options] = scenes::read_request(id.toStdString());
    options.grid = {3, 3};
    options.height = 120;
    options.width = 160;
    options.noise_sigma = noise;

    const Scene scene = scenes::render_builtin(scene_id, options, Progress());

    const quint64 actual = scene.light_field->sample_hash();
    QVERIFY2(actual == hash, qPrintable("now 0x" + QString::number(actual, 16)));
  }
};

}  // namespace episcope::in_builtin_hash_test

EPISCOPE_TEST(builtin_hash_test, BuiltinHashTest)
#include "builtin_hash_test.moc"
