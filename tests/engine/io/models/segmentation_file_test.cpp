// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/models/scribble_file.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace episcope::in_segmentation_file_test {

namespace {

constexpr int kHeight = 6;
constexpr int kWidth = 7;

io::StoredSegmentation labeling(GridShape grid, ViewIndex first) {
  io::StoredSegmentation stored;
  stored.labels = ViewStack<std::int32_t>(grid, kHeight, kWidth, 1, first);
  for (std::size_t i = 0; i < stored.labels.size(); ++i) {
    stored.labels.data()[i] = i % 3 == 0 ? 12 : 4;
  }
  stored.infos = {{4, "Löwe", {1, 2, 3}}, {12, "apple; red", {200, 0, 0}}};
  stored.parameters = {{"trees", 8}};
  stored.source = "lf.h5";
  stored.reading = {"archive", {{"flip", std::string("u")}, {"focus", 1.5}}};
  stored.seconds = 1.5;
  return stored;
}

// Every view has its own value.
std::vector<Volume<std::uint8_t>> probabilities(GridShape grid) {
  std::vector<Volume<std::uint8_t>> maps;
  for (int i = 0; i < grid.count(); ++i) {
    maps.emplace_back(kHeight, 2, kWidth);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        maps.back().view().at(y, 0, x) = static_cast<std::uint8_t>(10 * i + x);
        maps.back().view().at(y, 1, x) = static_cast<std::uint8_t>(255 - 10 * i - x);
      }
    }
  }
  return maps;
}

}  // namespace

class SegmentationFileTest : public QObject {
  Q_OBJECT

 private slots:
  void roundTrip_data();
  void roundTrip();
  void labels_takeLittleRoom_data();
  void labels_takeLittleRoom();
  void probabilities_mayBeLeftOut();
  void datasets_areNamedAsInTheArchive();
  void unknownReading_staysUnknown();
  void inputs_areNoLabelings();
  void unwritableFolder_leavesNothing();

 private:
  [[nodiscard]] std::filesystem::path path(const char* name) const {
    return std::filesystem::path(folder_.path().toStdString()) / name;
  }

  QTemporaryDir folder_;
};

void SegmentationFileTest::roundTrip_data() {
  QTest::addColumn<int>("rows");
  QTest::addColumn<int>("columns");
  QTest::newRow("one view") << 1 << 1;
  QTest::newRow("a part of the grid") << 2 << 3;
}

void SegmentationFileTest::roundTrip() {
  QFETCH(int, rows);
  QFETCH(int, columns);
  const GridShape grid{rows, columns};
  const ViewIndex first{1, 2};
  const io::StoredSegmentation stored = labeling(grid, first);
  const auto maps = probabilities(grid);

  io::write_segmentation(
      path("l.h5"), stored,
      [&](ViewIndex view) {
        return maps[static_cast<std::size_t>((view.v - 1) * columns + view.u - 2)].view();
      },
      Progress());
  const io::SegmentationFile read(path("l.h5"));

  QVERIFY(io::is_segmentation_file(path("l.h5")));
  QCOMPARE(read.grid(), grid);
  QCOMPARE(read.first(), first);
  QVERIFY(!read.contains({0, 2}));
  QVERIFY(read.infos() == stored.infos);
  QCOMPARE(QString::fromStdString(read.source()), QString("lf.h5"));
  QVERIFY(read.reading() == stored.reading);
  QVERIFY(read.has_probabilities());
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view{1 + i / columns, 2 + i % columns};
    const auto expected = stored.labels.view(view);
    const auto labels = read.labels(view);
    QVERIFY(std::equal(labels.begin(), labels.end(), expected.data));
    const auto p = read.probabilities(view);
    QCOMPARE(p.channels(), 2);
    QVERIFY(std::abs(p.at(3, 5, 0) - (10 * i + 5) / 255.0F) < 1e-6F);
    QVERIFY(std::abs(p.at(3, 5, 1) - (250 - 10 * i) / 255.0F) < 1e-6F);
  }
}

void SegmentationFileTest::labels_takeLittleRoom_data() {
  QTest::addColumn<int>("id");
  QTest::addColumn<int>("type");
  QTest::newRow("bytes") << 255 << static_cast<int>(io::Hdf5Type::UInt8);
  QTest::newRow("16 bits") << 300 << static_cast<int>(io::Hdf5Type::UInt16);
  QTest::newRow("32 bits") << 70000 << static_cast<int>(io::Hdf5Type::Integer);
}

void SegmentationFileTest::labels_takeLittleRoom() {
  QFETCH(int, id);
  QFETCH(int, type);
  constexpr int kSide = 128;
  io::StoredSegmentation stored = labeling({9, 9}, {});
  stored.labels = ViewStack<std::int32_t>({9, 9}, kSide, kSide);
  for (std::size_t i = 0; i < stored.labels.size(); ++i) {
    stored.labels.data()[i] = i % kSide < kSide / 2 ? 1 : id;
  }

  io::write_segmentation(path("small.h5"), stored, nullptr, Progress());

  QCOMPARE(static_cast<int>(io::Hdf5Input(path("small.h5")).dataset("LABELS").type), type);
  QVERIFY(std::filesystem::file_size(path("small.h5")) < stored.labels.size() / 8);
  const Image<std::int32_t> read = io::SegmentationFile(path("small.h5")).labels({4, 7});
  QVERIFY(std::equal(read.begin(), read.end(), stored.labels.view({4, 7}).data));
}

void SegmentationFileTest::probabilities_mayBeLeftOut() {
  io::write_segmentation(path("bare.h5"), labeling({1, 1}, {0, 0}), {}, Progress());

  QVERIFY(!io::SegmentationFile(path("bare.h5")).has_probabilities());
}

void SegmentationFileTest::datasets_areNamedAsInTheArchive() {
  const GridShape grid{2, 2};
  const auto maps = probabilities(grid);
  io::write_segmentation(
      path("named.h5"), labeling(grid, {0, 0}),
      [&](ViewIndex view) { return maps[static_cast<std::size_t>(view.v * 2 + view.u)].view(); },
      Progress());

  const io::Hdf5Input file(path("named.h5"));
  QCOMPARE(file.dataset("LABELS").shape, (io::Hdf5Shape{2, 2, kHeight, kWidth}));
  QCOMPARE(file.dataset("Probabilities").shape, (io::Hdf5Shape{2, 2, kHeight, kWidth, 2}));
  QCOMPARE(QString::fromStdString(file.text("LABELS", "axes").value_or("")), QString("v,u,y,x"));
  QCOMPARE(QString::fromStdString(file.text("Probabilities", "axes").value_or("")),
           QString("v,u,y,x,label"));
}

void SegmentationFileTest::unknownReading_staysUnknown() {
  io::StoredSegmentation stored = labeling({1, 1}, {0, 0});
  stored.reading = {};
  io::write_segmentation(path("former.h5"), stored, {}, Progress());

  QVERIFY(io::SegmentationFile(path("former.h5")).reading() == Reading());
}

void SegmentationFileTest::inputs_areNoLabelings() {
  std::ofstream(path("text.h5")) << "no HDF5";

  QVERIFY(!io::is_segmentation_file(path("text.h5")));
  QVERIFY(!io::is_segmentation_file(path("missing.h5")));
}

void SegmentationFileTest::unwritableFolder_leavesNothing() {
  QVERIFY_THROWS_EXCEPTION(
      IoError, io::write_segmentation(path("no/such/l.h5"), labeling({1, 1}, {}), {}, Progress()));
}

}  // namespace episcope::in_segmentation_file_test

EPISCOPE_TEST(segmentation_file_test, SegmentationFileTest)
#include "segmentation_file_test.moc"
