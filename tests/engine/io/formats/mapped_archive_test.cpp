// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/memory.h"
#include "engine/io/formats/write_arrays.h"
#include "engine/io/formats/write_scene.h"
#include "tests/engine/io/archive_files.h"
#include "tests/engine/io/archive_folder.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <hdf5.h>

#include <algorithm>

// Light fields that are large beside the budget stay in their file, and are the same.

namespace episcope::in_mapped_archive_test {

using namespace episcope::test;

namespace {

// Less than three times the samples of a plane scene.
constexpr std::size_t kSmallBudget = 512 << 10;

const ViewStack<std::uint8_t>& samples_of(const Scene& scene) {
  return std::get<ViewStack<std::uint8_t>>(scene.light_field->samples());
}

LargeKind kind_of(const Scene& scene) {
  return samples_of(scene).kind();
}

// View by view: what is mapped may lie in memory in any order.
bool same_views(const Scene& a, const Scene& b) {
  const auto &of_a = samples_of(a), &of_b = samples_of(b);
  if (!(of_a.grid() == of_b.grid()) || of_a.view_size() != of_b.view_size()) return false;
  for (int i = 0; i < of_a.grid().count(); ++i) {
    const ViewIndex view = of_a.view_at(i);
    const std::uint8_t* const first = of_a.view(view).data;
    if (!std::equal(first, first + of_a.view_size(), of_b.view(view).data)) return false;
  }
  return true;
}

// Whether the one is mapped and otherwise like the other.
bool is_mapped_alike(const Scene& mapped, const Scene& in_memory) {
  return kind_of(mapped) == LargeKind::File && same_views(mapped, in_memory) &&
         mapped.light_field->sample_hash() == in_memory.light_field->sample_hash() &&
         mapped.convention.order == in_memory.convention.order &&
         mapped.convention.crop.kept == in_memory.convention.crop.kept;
}

void store_in_chunks(const std::filesystem::path& from, const std::filesystem::path& to,
                     const Scene& scene) {
  std::filesystem::copy_file(from, to);
  const hid_t file = H5Fopen(to.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  H5Ldelete(file, "LF", H5P_DEFAULT);
  const LightField& lf = *scene.light_field;
  const auto length = [](int value) { return static_cast<hsize_t>(value); };
  const hsize_t shape[] = {length(lf.grid().v), length(lf.grid().u), length(lf.height()),
                           length(lf.width()), 3};
  const hsize_t chunk[] = {1, 1, shape[2], shape[3], 3};
  const hid_t space = H5Screate_simple(5, shape, nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(creation, 5, chunk);
  H5Pset_deflate(creation, 1);
  const hid_t data =
      H5Dcreate2(file, "LF", H5T_NATIVE_UINT8, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  H5Dwrite(data, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes_of(scene).data());
  H5Dclose(data);
  H5Pclose(creation);
  H5Sclose(space);
  H5Fclose(file);
}

}  // namespace

class MappedArchiveTest : public QObject, private ArchiveFolder {
  Q_OBJECT

 private slots:
  void init() { renew(); }
  void cleanup() { set_memory_budget({}); }

  void smallLightField_isReadIntoMemory() {
    io::write_archive(path("lf.h5"), plane_scene(), Progress(1));

    QVERIFY(kind_of(open(path("lf.h5"))) == LargeKind::Heap);
  }

  void largeLightField_isMapped() {
    const Scene scene = plane_scene();
    io::write_archive(path("lf.h5"), scene, Progress(1));
    set_memory_budget(kSmallBudget);

    const Scene mapped = open(path("lf.h5"));

    QVERIFY(kind_of(mapped) == LargeKind::File);
    QVERIFY(same_views(mapped, scene));
    QCOMPARE(mapped.light_field->sample_hash(), scene.light_field->sample_hash());
    QVERIFY(mapped.convention.samples.find("mapped") != std::string::npos);
    QVERIFY2(mapped.convention.warnings.empty(), describe(mapped.convention).c_str());
  }

  void forgottenSamples_areReadAgain() {
    const Scene scene = plane_scene();
    io::write_archive(path("lf.h5"), scene, Progress(1));
    set_memory_budget(kSmallBudget);
    const Scene mapped = open(path("lf.h5"));

    mapped.light_field->forget_samples();

    QVERIFY(same_views(mapped, scene));
  }

  void reversedViews_arePutInOrderWithoutMoving_data() {
    QTest::addColumn<bool>("u");
    QTest::addColumn<bool>("v");
    QTest::newRow("u") << true << false;
    QTest::newRow("v") << false << true;
    QTest::newRow("both") << true << true;
  }
  void reversedViews_arePutInOrderWithoutMoving() {
    QFETCH(bool, u);
    QFETCH(bool, v);
    RawArchive form;
    form.flip = {u, v};
    write_raw_archive(path("lf.h5"), plane_scene(), form);
    const Scene in_memory = open(path("lf.h5"));
    set_memory_budget(kSmallBudget);

    const Scene mapped = open(path("lf.h5"));

    QVERIFY(!samples_of(mapped).is_in_order());
    QVERIFY(is_mapped_alike(mapped, in_memory));
  }

  void croppedViews_arePutInOrderWithoutMoving() {
    RawArchive form;
    form.flip = {true, false};
    write_raw_archive(path("lf.h5"), plane_scene(), form);
    const Scene in_memory = open(path("lf.h5"), {.crop = "3x2"});
    set_memory_budget(kSmallBudget / 2);

    const Scene mapped = open(path("lf.h5"), {.crop = "3x2"});

    QVERIFY(is_mapped_alike(mapped, in_memory));
  }

  void convertedAgain_isTheSame_data() {
    QTest::addColumn<QString>("name");
    QTest::newRow("archive") << "again.h5";
    QTest::newRow("npy") << "again.npy";
    QTest::newRow("mat") << "again.mat";
  }
  void convertedAgain_isTheSame() {
    QFETCH(QString, name);
    RawArchive form;
    form.flip = {true, false};
    write_raw_archive(path("lf.h5"), plane_scene(), form);
    const Scene in_memory = open(path("lf.h5"));
    set_memory_budget(kSmallBudget);
    const Scene mapped = open(path("lf.h5"));
    const std::filesystem::path again = path() / name.toStdString();

    if (again.extension() == ".h5") io::write_archive(again, mapped, Progress(1));
    if (again.extension() == ".npy") io::write_npy(again, mapped, Progress(1));
    if (again.extension() == ".mat") io::write_mat(again, mapped, Progress(1));
    set_memory_budget({});

    QVERIFY(same_views(open(again), in_memory));
  }

  void evenedOutViews_areReadIntoMemory() {
    io::write_archive(path("lf.h5"), plane_scene(), Progress(1));
    set_memory_budget(kSmallBudget);

    QVERIFY(kind_of(open(path("lf.h5"), {.equalize = true})) != LargeKind::File);
  }

  void compressedLightField_isUnpackedToDisk() {
    const Scene scene = plane_scene({.height = 256, .width = 320});
    io::write_archive(path("lf.h5"), scene, Progress(1));
    store_in_chunks(path("lf.h5"), path("chunked.h5"), scene);
    set_memory_budget(kSmallBudget);

    const Scene unpacked = open(path("chunked.h5"));

    QVERIFY(kind_of(unpacked) == LargeKind::Scratch);
    QVERIFY(same_views(unpacked, scene));
    QCOMPARE(unpacked.light_field->sample_hash(), scene.light_field->sample_hash());
  }

  void darkViews_areFoundWhereSamplesAreMapped() {
    const Scene scene = plane_scene();
    ViewStack<std::uint8_t> samples = bytes_of(scene).clone();
    const auto corner = samples.view({0, 0});
    std::fill_n(corner.data, corner.size(), std::uint8_t{0});
    const auto other = samples.view({0, 4});
    std::fill_n(other.data, other.size(), std::uint8_t{0});
    Scene dark;
    dark.light_field =
        std::make_shared<const LightField>(std::move(samples), scene.light_field->info());
    dark.truth = std::make_shared<const GroundTruth>();
    io::write_archive(path("lf.h5"), dark, Progress(1));
    const Scene in_memory = open(path("lf.h5"));
    set_memory_budget(kSmallBudget);

    const Scene mapped = open(path("lf.h5"));

    QVERIFY(in_memory.convention.crop.leaves_out());
    QVERIFY(is_mapped_alike(mapped, in_memory));
  }
};

}  // namespace episcope::in_mapped_archive_test

EPISCOPE_TEST(mapped_archive_test, MappedArchiveTest)
#include "mapped_archive_test.moc"
