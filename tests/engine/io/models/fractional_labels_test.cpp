// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/hdf5_output.h"
#include "engine/io/base/npy.h"
#include "engine/io/open.h"
#include "tests/engine/io/formats/array_files.h"
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <algorithm>

namespace episcope::in_fractional_labels_test {

using namespace episcope::test;

namespace fs = std::filesystem;

namespace {

ViewStack<float> times(const ViewStack<float>& maps, float factor) {
  ViewStack<float> scaled = maps.clone();
  std::for_each(scaled.data(), scaled.data() + scaled.size(), [=](float& d) { d *= factor; });
  return scaled;
}

ViewStack<float> as_floats(const ViewStack<std::int32_t>& labels) {
  ViewStack<float> floats(labels.grid(), labels.height(), labels.width());
  std::copy_n(labels.data(), labels.size(), floats.data());
  return floats;
}

bool is_same(const ViewStack<float>& a, const ViewStack<float>& b) {
  return a.size() == b.size() && std::equal(a.data(), a.data() + a.size(), b.data());
}

bool is_said(const Scene& read) {
  return read.convention.units.find("named like labels, but with fractions") != std::string::npos;
}

}  // namespace

/// EPINET and others call their disparity `label`; it is no label.
class FractionalLabelsTest : public QObject {
  Q_OBJECT

 private:
  LayeredFolder folder_;
  const LayeredScene& scene_ = folder_.scene;

  void write_npz(const std::string& name, const ViewStack<float>& maps) const {
    io::write_npy<std::uint8_t>(folder_.path("a"), lengths_of(scene_.views, "vuyxc"),
                                in_axes(scene_.views, "vuyxc"));
    io::write_npy<float>(folder_.path("b"), lengths_of(scene_.views, "vuyx"),
                         {maps.data(), maps.size()});
    write_deflated_zip(folder_.path("lf.npz"), {{"LF.npy", bytes_of_file(folder_.path("a"))},
                                                {name + ".npy", bytes_of_file(folder_.path("b"))}});
    fs::remove(folder_.path("a"));
    fs::remove(folder_.path("b"));
  }
  void write_hdf5(const std::string& views, const ViewStack<float>& label) const {
    io::AtomicFile target(folder_.path("lf.h5"));
    io::Hdf5Output file(target);
    const auto shape = lengths_of(scene_.views, "vuyxc");
    file.add_dataset<std::uint8_t>(views, shape, "", "");
    file.write(views, {io::Hdf5Shape(5, 0), shape}, in_axes(scene_.views, "vuyxc").data());
    const auto axes = lengths_of(scene_.views, "vuyx");
    file.add_dataset<float>("label", axes, "", "");
    file.write("label", {io::Hdf5Shape(4, 0), axes}, label.data());
    file.close();
    target.commit();
  }

 private slots:
  void init() { folder_ = LayeredFolder(); }

  void labelsWithFractions_areDisparity_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("label") << "label";
    QTest::newRow("traindata_label") << "traindata_label";
    QTest::newRow("seg") << "seg";
  }
  void labelsWithFractions_areDisparity() {
    QFETCH(QString, name);
    write_npz(name.toStdString(), scene_.disparity);

    const Scene read = folder_.open("lf.npz");

    QVERIFY(is_same(read.truth->field.disparity, scene_.disparity));
    QVERIFY(read.truth->labels.empty());
    QVERIFY2(is_said(read), read.convention.units.c_str());
    QCOMPARE(count_used(read, "disparity maps"), 1);
  }

  void signAndUnit_areCheckedAsOfOtherMaps() {
    write_npz("label", times(scene_.disparity, -1));

    const Scene read = folder_.open("lf.npz");

    QVERIFY2(is_same(read.truth->field.disparity, scene_.disparity),
             describe(read.convention).c_str());
  }

  void wholeNumbersInFloats_stayLabels() {
    write_npz("label", as_floats(scene_.labels));

    const Scene read = folder_.open("lf.npz");

    QVERIFY(!read.truth->has_disparity());
    const ViewStack<std::int32_t>& labels = read.truth->labels;
    QCOMPARE(labels.size(), scene_.labels.size());
    QVERIFY(std::equal(labels.data(), labels.data() + labels.size(), scene_.labels.data()));
  }

  void inHdf5_theyAreDisparity_data() {
    QTest::addColumn<QString>("views");
    QTest::newRow("as in the archive") << "LF";
    QTest::newRow("of another name") << "data";
  }
  void inHdf5_theyAreDisparity() {
    QFETCH(QString, views);
    write_hdf5(views.toStdString(), scene_.disparity);

    const Scene read = folder_.open("lf.h5");

    QVERIFY(is_same(read.truth->field.disparity, scene_.disparity));
    QVERIFY2(is_said(read), read.convention.units.c_str());
  }

  void inMatlab_theyAreDisparity() {
    write_mat5(folder_.path("lf.mat"), scene_.views, {.label = scene_.disparity.view({1, 1})});

    const Scene read = folder_.open("lf.mat");

    const auto map = read.truth->field.disparity.view({1, 1});
    QVERIFY(std::equal(map.data, map.data + map.size(), scene_.disparity.view({1, 1}).data));
    QVERIFY2(is_said(read), read.convention.units.c_str());
  }

  void besideViews_theyAreDisparity_data() {
    QTest::addColumn<QString>("suffix");
    for (const char* suffix : {".npy", ".npz", ".mat", ".h5"}) QTest::newRow(suffix) << suffix;
  }
  void besideViews_theyAreDisparity() {
    QFETCH(QString, suffix);
    folder_.write_views(LayeredFolder::named("{}_{}.png"));
    const auto map = scene_.disparity.view({1, 1});
    const fs::path file = folder_.path("label" + suffix.toStdString());
    if (suffix == ".npy") folder_.write_npy("label.npy", map);
    if (suffix == ".mat") write_mat5_map(file, "label", map);
    if (suffix == ".npz") {
      folder_.write_npy("map", map);
      write_deflated_zip(file, {{"label.npy", bytes_of_file(folder_.path("map"))}});
      fs::remove(folder_.path("map"));
    }
    if (suffix == ".h5") {
      io::AtomicFile target(file);
      io::Hdf5Output output(target);
      const auto shape = lengths_of(scene_.views, "yx");
      output.add_dataset<float>("label", shape, "", "");
      output.write("label", {{0, 0}, shape}, map.data);
      output.close();
      target.commit();
    }

    const Scene read = folder_.open();

    QVERIFY2(read.truth->has_disparity(), describe(read.convention).c_str());
    const auto found = read.truth->field.disparity.view({1, 1});
    QVERIFY(std::equal(found.data, found.data + found.size(), map.data));
    QVERIFY(read.truth->labels.empty());
    QVERIFY2(is_said(read), read.convention.units.c_str());
  }

  void besideDisparity_theyAreLeftOut() {
    folder_.write_views(LayeredFolder::named("{}_{}.png"));
    folder_.write_npy(LayeredFolder::named("{}_{}_disparity.npy"), scene_.disparity);
    folder_.write_npy(LayeredFolder::named("{}_{}_label.npy"), times(scene_.disparity, 3));

    const Scene read = folder_.open();

    QVERIFY(is_same(read.truth->field.disparity, scene_.disparity));
    QCOMPARE(count_unused(read, "maps named like labels, but with fractions"), 9);
  }
};

}  // namespace episcope::in_fractional_labels_test

EPISCOPE_TEST(fractional_labels_test, FractionalLabelsTest)
#include "fractional_labels_test.moc"
