// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/core/version.h"
#include "engine/io/base/exchange_files.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/result_file.h"
#include "tests/test_main.h"

#include <QTemporaryDir>

#include <hdf5.h>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>

namespace episcope::in_result_test {

namespace {

constexpr GridShape kGrid{3, 5};
constexpr int kHeight = 6;
constexpr int kWidth = 7;

DisparityField sample_field(GridShape views, ViewIndex first) {
  DisparityField field;
  field.disparity = ViewStack<float>(views, kHeight, kWidth, 1, first);
  field.valid = ViewStack<std::uint8_t>(views, kHeight, kWidth, 1, first);
  for (std::size_t i = 0; i < field.disparity.size(); ++i) {
    field.disparity.data()[i] = 0.01F * static_cast<float>(i) - 1;
    field.valid.data()[i] = i % 5 == 0 ? 0 : 1;
  }
  return field;
}

void compare(const DisparityField& read, const DisparityField& written) {
  QCOMPARE(read.disparity.grid(), written.disparity.grid());
  QCOMPARE(read.disparity.first(), written.disparity.first());
  for (std::size_t i = 0; i < written.disparity.size(); ++i) {
    QCOMPARE(read.valid.data()[i], written.valid.data()[i]);
    if (written.valid.data()[i] != 0) {
      QCOMPARE(read.disparity.data()[i], written.disparity.data()[i]);
    }
  }
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

class ResultTest : public QObject {
  Q_OBJECT

 private:
  std::unique_ptr<QTemporaryDir> folder_;
  std::filesystem::path path(const char* name) const {
    return std::filesystem::path(folder_->path().toStdString()) / name;
  }
  void write_floats(const char* file,
                    const std::vector<std::pair<std::string, io::Hdf5Shape>>& sets,
                    float value) const {
    io::AtomicFile target(path(file));
    io::Hdf5Output out(target);
    for (const auto& [name, shape] : sets) {
      std::size_t count = 1;
      for (const std::size_t length : shape) count *= length;
      const std::size_t slash = name.find('/');
      if (slash != std::string::npos) out.add_group(name.substr(0, slash));
      out.add_dataset<float>(name, shape, "", "");
      out.write(name, {io::Hdf5Shape(shape.size(), 0), shape},
                std::vector<float>(count, value).data());
    }
    out.close();
    target.commit();
  }
  /// A dataset, with an attribute that states the order of its axes: "x,y,u,v" itself, or [x][y]
  /// in the way of this attribute.
  void write_stated(const std::string& name, const QString& statement, const io::Hdf5Shape& shape,
                    const std::vector<float>& values) const {
    io::AtomicFile target(path("stated.h5"));
    io::Hdf5Output out(target);
    if (name.starts_with("estimate/")) out.add_group("estimate");
    const bool is_list = statement.contains(',');
    out.add_dataset<float>(name, shape,
                           is_list               ? statement.toStdString()
                           : statement == "axes" ? "x,y"
                                                 : "",
                           "");
    out.write(name, {io::Hdf5Shape(shape.size(), 0), shape}, values.data());
    if (statement == "MATLAB_class") out.set_ascii(name, "MATLAB_class", "single");
    out.close();
    if (statement == "DIMENSION_LABELS") list_axes(target.temporary(), name, "DIMENSION_LABELS");
    if (statement == "list of axes") list_axes(target.temporary(), name, "axes");
    if (statement == "DIMENSION_LIST") attach_scales(target.temporary(), name);
    target.commit();
  }
  static void list_axes(const std::filesystem::path& file, const std::string& name,
                        const char* as_attribute) {
    const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t dataset = H5Dopen2(id, name.c_str(), H5P_DEFAULT);
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, H5T_VARIABLE);
    const hsize_t count = 2;
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    if (H5Aexists(dataset, as_attribute) > 0) H5Adelete(dataset, as_attribute);
    const hid_t attribute =
        H5Acreate2(dataset, as_attribute, type, space, H5P_DEFAULT, H5P_DEFAULT);
    const char* const labels[] = {"columns", "rows"};
    QVERIFY(H5Awrite(attribute, type, labels) >= 0);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(dataset);
    H5Fclose(id);
  }
  /// As h5py and netCDF attach the scales "x" and "y".
  static void attach_scales(const std::filesystem::path& file, const std::string& name) {
    const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t dataset = H5Dopen2(id, name.c_str(), H5P_DEFAULT);
    hobj_ref_t references[2];
    hvl_t axes[2];
    for (const int axis : {0, 1}) {
      const char* scale = axis == 0 ? "x" : "y";
      const hsize_t length = 1;
      const hid_t space = H5Screate_simple(1, &length, nullptr);
      H5Dclose(H5Dcreate2(id, scale, H5T_NATIVE_INT, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
      H5Sclose(space);
      QVERIFY(H5Rcreate(&references[axis], id, scale, H5R_OBJECT, -1) >= 0);
      axes[axis] = {1, &references[axis]};
    }
    const hsize_t count = 2;
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t type = H5Tvlen_create(H5T_STD_REF_OBJ);
    const hid_t attribute =
        H5Acreate2(dataset, "DIMENSION_LIST", type, space, H5P_DEFAULT, H5P_DEFAULT);
    QVERIFY(H5Awrite(attribute, type, axes) >= 0);
    H5Aclose(attribute);
    H5Tclose(type);
    H5Sclose(space);
    H5Dclose(dataset);
    H5Fclose(id);
  }

 private slots:
  void init() { folder_ = std::make_unique<QTemporaryDir>(); }

  void result_readsWhatItWrote_data() {
    QTest::addColumn<bool>("is_all_views");
    QTest::newRow("all views") << true;
    QTest::newRow("one view") << false;
  }
  void result_readsWhatItWrote() {
    QFETCH(bool, is_all_views);
    const GridShape views = is_all_views ? kGrid : GridShape{1, 1};
    const ViewIndex first = is_all_views ? ViewIndex{} : ViewIndex{2, 4};
    Estimate estimate;
    estimate.field = sample_field(views, first);
    estimate.confidence = ViewStack<float>(views, kHeight, kWidth, 1, first);
    std::fill_n(estimate.confidence.data(), estimate.confidence.size(), 0.25F);
    estimate.method = "epi_s";
    estimate.parameters = {{"scale", 0.8},
                           {"whole", 2.0},
                           {"steps", 12},
                           {"fast", true},
                           {"kind", std::string("größer")},
                           {"range", IntervalOrAuto(Interval{-1.5, 2})},
                           {"window", IntervalOrAuto{}},
                           {"view", ViewOrAuto(ViewIndex{3, 5})}};
    estimate.range = {-1.5, 2};
    estimate.seconds = 1.25;
    estimate.source = "/somewhere/lf.h5";
    estimate.source_hash = 0xFEDCBA9876543210U;
    estimate.notes = {"gap 0.001", "two views unsolved"};
    estimate.camera = {2.5, 4, 1.25, 8, Pinhole{120, 3.5, 3}};
    estimate.device = "CPU";
    estimate.commit = "0123abc";
    estimate.date = "2026-11-27T22:43:23Z";

    io::write_result(path("r.h5"), estimate, Progress(1));
    const Estimate read = io::read_result(path("r.h5"), kGrid);

    QVERIFY(io::is_result_file(path("r.h5")));
    compare(read.field, estimate.field);
    QCOMPARE(read.confidence.first(), first);
    QCOMPARE(read.confidence.data()[3], 0.25F);
    QCOMPARE(read.method, estimate.method);
    QVERIFY(read.parameters == estimate.parameters);
    QCOMPARE(read.range, estimate.range);
    QCOMPARE(read.seconds, 1.25);
    QCOMPARE(read.version, std::string(kVersion));
    QCOMPARE(read.source, estimate.source);
    QCOMPARE(read.source_hash, estimate.source_hash);
    QVERIFY(read.notes == estimate.notes);
    QCOMPARE(read.camera.depth_from_disparity(0.75), 5.0);
    QCOMPARE(read.camera.cam_distance.value(), 8.0);
    QCOMPARE(read.camera.pinhole.value().center_x, 3.5);
    QCOMPARE(read.device, estimate.device);
    QCOMPARE(read.commit, estimate.commit);
    QCOMPARE(read.date, estimate.date);
  }

  /// Former versions wrote texts of fixed length, and no more than this.
  void fileOfFormerVersion_isRead() {
    {
      io::AtomicFile target(path("old.h5"));
      io::Hdf5Output out(target);
      out.add_group("estimate");
      out.add_dataset<float>("estimate/disparity", {kHeight, kWidth}, "y,x", "px per view step");
      const std::vector<float> values(kHeight * kWidth, 0.5F);
      out.write("estimate/disparity", {{0, 0}, {kHeight, kWidth}}, values.data());
      out.set_ascii("estimate", "method", "epi_l");
      out.set_ascii("estimate", "parameters", R"({"profile":"tuned"})");
      out.set_ascii("estimate", "source", "lf.h5");
      out.set_number("estimate", "seconds", 1.25);
      out.set_integers("estimate", "view", {2, 4});
      out.close();
      target.commit();
    }

    const Estimate read = io::read_result(path("old.h5"), kGrid);

    QCOMPARE(read.method, std::string("epi_l"));
    QCOMPARE(read.source, std::string("lf.h5"));
    QCOMPARE(read.parameters.size(), std::size_t{1});
    QCOMPARE(read.field.disparity.first(), (ViewIndex{2, 4}));
    QCOMPARE(read.field.disparity.data()[5], 0.5F);
    QVERIFY(!read.camera.is_known());
    QVERIFY(read.date.empty() && read.device.empty());
  }

  void texts_areOfVariableLength() {
    Estimate estimate;
    estimate.field = sample_field(kGrid, {});
    estimate.method = "größer";

    io::write_result(path("r.h5"), estimate, Progress(1));

    const hid_t file = H5Fopen(path("r.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t text = H5Aopen_by_name(file, "estimate", "method", H5P_DEFAULT, H5P_DEFAULT);
    const hid_t type = H5Aget_type(text);
    const bool is_variable = H5Tis_variable_str(type) > 0;
    const H5T_cset_t letters = H5Tget_cset(type);
    H5Tclose(type);
    H5Aclose(text);
    H5Fclose(file);
    QVERIFY(is_variable);
    QCOMPARE(letters, H5T_CSET_UTF8);
  }

  /// HDF5 1.10 copies beyond its memory where lengths of texts are damaged.
  void damagedTexts_doNoHarm() {
    Estimate estimate;
    estimate.field = sample_field({1, 1}, kGrid.center());
    estimate.method = "epi_l";
    io::write_result(path("r.h5"), estimate, Progress(1));
    const std::string sound = text_of(path("r.h5"));
    const std::size_t texts = sound.find("GCOL");
    QVERIFY(texts != std::string::npos);

    for (std::size_t at = texts + 8; at < texts + 256; ++at) {
      std::string damaged = sound;
      damaged[at] = '\xFF';
      std::ofstream(path("damaged.h5"), std::ios::binary) << damaged;
      try {
        QVERIFY(!io::read_result(path("damaged.h5"), kGrid).field.empty());
      } catch (const IoError&) {
        continue;  // as good
      }
    }
  }

  void layers_areKept() {
    Estimate estimate;
    estimate.field = sample_field({1, 1}, kGrid.center());
    estimate.layered.foreground = sample_field({1, 1}, kGrid.center());
    estimate.layered.background = sample_field({1, 1}, kGrid.center());
    estimate.layered.background.valid.data()[7] = 0;
    estimate.layered.layers = ViewStack<std::uint8_t>({1, 1}, kHeight, kWidth, 1, kGrid.center());
    std::fill_n(estimate.layered.layers.data(), estimate.layered.layers.size(), std::uint8_t{2});

    io::write_result(path("r.h5"), estimate, Progress(1));
    const Estimate read = io::read_result(path("r.h5"), kGrid);

    compare(read.layered.foreground, estimate.layered.foreground);
    compare(read.layered.background, estimate.layered.background);
    QCOMPARE(read.layered.layers.data()[0], std::uint8_t{2});
  }

  void secondDisparity_isKept() {
    Estimate estimate;
    estimate.field = sample_field({1, 1}, kGrid.center());
    estimate.second = sample_field({1, 1}, kGrid.center());
    estimate.second.require_mask();
    estimate.second.valid.data()[7] = 0;
    estimate.second.disparity.data()[7] = 0;

    io::write_result(path("r.h5"), estimate, Progress(1));
    const Estimate read = io::read_result(path("r.h5"), kGrid);

    compare(read.second, estimate.second);
  }

  void file_statesAxesUnitsAndInvalidPixels() {
    Estimate estimate;
    estimate.field = sample_field(kGrid, {});

    io::write_result(path("r.h5"), estimate, Progress(1));
    const io::Hdf5Input file(path("r.h5"));
    float first = 0;
    file.read("estimate/disparity", {{0, 0, 0, 0}, {1, 1, 1, 1}}, &first);

    QCOMPARE(*file.text("estimate/disparity", "axes"), std::string("v,u,y,x"));
    QCOMPARE(*file.text("estimate/disparity", "units"), std::string("px per view step"));
    QCOMPARE(*file.text("estimate/valid", "axes"), std::string("v,u,y,x"));
    QCOMPARE(*file.text("estimate/valid", "units"), std::string("1"));
    QVERIFY(file.text("estimate/valid", "long_name").has_value());
    QVERIFY(file.text("estimate", "sign")->starts_with("positive disparity = nearer"));
    QVERIFY(std::isnan(first));
  }

  /// Masks always are, maps on request; nothing is lost.
  void compressedResult_holdsTheSame() {
    Estimate estimate;
    estimate.field = sample_field(kGrid, {});
    estimate.confidence = ViewStack<float>(kGrid, kHeight, kWidth);
    std::fill_n(estimate.confidence.data(), estimate.confidence.size(), 0.25F);

    io::write_result(path("plain.h5"), estimate, Progress(1));
    io::write_result(path("packed.h5"), estimate, Progress(1),
                     {.floats = io::Hdf5Storage::Deflated});
    const Estimate read = io::read_result(path("packed.h5"), kGrid);

    const io::Hdf5Shape view{1, 1, kHeight, kWidth};
    QVERIFY(io::Hdf5Input(path("plain.h5")).dataset("estimate/valid").chunk == view);
    QVERIFY(io::Hdf5Input(path("plain.h5")).dataset("estimate/disparity").chunk.empty());
    QVERIFY(io::Hdf5Input(path("packed.h5")).dataset("estimate/disparity").chunk == view);
    compare(read.field, estimate.field);
    QVERIFY(std::equal(read.confidence.data(), read.confidence.data() + read.confidence.size(),
                       estimate.confidence.data()));
  }

  /// The axes of every map are datasets of their places, as netCDF has them.
  void axes_areDimensionScales() {
    Estimate estimate;
    estimate.field = sample_field({2, 2}, {1, 3});

    io::write_result(path("r.h5"), estimate, Progress(1));
    const io::Hdf5Input file(path("r.h5"));

    for (const char* map : {"estimate/disparity", "estimate/valid"}) {
      QVERIFY(file.texts(map, "DIMENSION_LABELS") ==
              (std::vector<std::string>{"v", "u", "y", "x"}));
      QVERIFY(file.has_attribute(map, "DIMENSION_LIST"));
    }
    std::int32_t places[2] = {};
    file.read("estimate/u", {{0}, {2}}, places);
    QCOMPARE(places[0], 3);
    QCOMPARE(places[1], 4);
    QCOMPARE(*file.text("estimate/u", "CLASS"), std::string("DIMENSION_SCALE"));
    QCOMPARE(file.dataset("estimate/x").shape, io::Hdf5Shape{kWidth});
  }

  void foreignMaps_belongToTheCenterView_data() {
    QTest::addColumn<QString>("kind");
    for (const char* kind : {"pfm", "tiff", "h5", "submission"}) QTest::newRow(kind) << kind;
  }
  void foreignMaps_belongToTheCenterView() {
    QFETCH(QString, kind);
    Image<float> map(kHeight, kWidth, 1, 0.5F);
    map.at(1, 2) = std::numeric_limits<float>::quiet_NaN();
    map.at(1, 3) = std::numeric_limits<float>::infinity();
    std::filesystem::path file = path(("map." + kind).toStdString().c_str());
    std::string scene;
    if (kind == "pfm") io::write_pfm(file, map.view());
    if (kind == "tiff") io::write_tiff(file, map.view());
    if (kind == "h5") {
      io::AtomicFile target(file);
      io::Hdf5Output out(target);
      out.add_dataset<float>("depth_map", {kHeight, kWidth}, "", "");
      out.write("depth_map", {{0, 0}, {kHeight, kWidth}}, map.data());
      out.close();
      target.commit();
    }
    if (kind == "submission") {
      file = path("sub");
      scene = "cotton";
      std::filesystem::create_directories(file / "disp_maps");
      std::filesystem::create_directories(file / "runtimes");
      io::write_pfm(file / "disp_maps/cotton.pfm", map.view());
      io::write_pfm(file / "disp_maps/boxes.pfm", Image<float>(2, 2).view());
      std::ofstream(file / "runtimes/cotton.txt") << "12.5\n";
    }

    const Estimate read = io::read_result(file, kGrid, scene);

    QVERIFY(!io::is_result_file(file));
    QCOMPARE(read.field.disparity.grid(), (GridShape{1, 1}));
    QCOMPARE(read.field.disparity.first(), kGrid.center());
    const DisparityView view = read.field.view(kGrid.center());
    QCOMPARE(view.disparity.at(0, 0), 0.5F);
    QVERIFY(!view.is_valid(1, 2) && !view.is_valid(1, 3) && view.is_valid(1, 4));
    QCOMPARE(read.seconds, kind == "submission" ? 12.5 : 0.0);
  }

  void foreignHdf5_mayHoldAllViews() {
    write_floats("all.h5", {{"result/d", {3, 5, 6, 7}}}, 0.75F);
    write_floats("other.h5", {{"d", {9, 9, 6, 7}}}, 0.75F);

    QCOMPARE(io::read_result(path("all.h5"), kGrid).field.disparity.grid(), kGrid);
    QVERIFY_THROWS_EXCEPTION(IoError, (void)io::read_result(path("other.h5"), kGrid));
  }

  /// Rows and columns are exchanged in the file, which says so.
  void statedAxes_areHonored_data() {
    QTest::addColumn<QString>("statement");
    QTest::addColumn<bool>("is_exchanged");
    QTest::newRow("none") << "" << false;
    QTest::newRow("axes") << "axes" << true;
    QTest::newRow("words") << "width,height" << true;
    QTest::newRow("list") << "list of axes" << true;
    QTest::newRow("MATLAB") << "MATLAB_class" << true;
    QTest::newRow("labels of dimensions") << "DIMENSION_LABELS" << true;
    QTest::newRow("scales of dimensions") << "DIMENSION_LIST" << true;
  }
  void statedAxes_areHonored() {
    QFETCH(QString, statement);
    QFETCH(bool, is_exchanged);
    const std::vector<float> stored{0, 1, 2, 3, 4, 5};
    for (const bool is_own : {false, true}) {
      const std::string name = is_own ? "estimate/disparity" : "map";
      write_stated(name, statement, {2, 3}, stored);
      const Estimate read = io::read_result(path("stated.h5"), kGrid);

      const auto map = read.field.disparity.view(kGrid.center());
      QCOMPARE(io::is_result_file(path("stated.h5")), is_own);
      QCOMPARE(map.height, is_exchanged ? 3 : 2);
      QCOMPARE(is_exchanged ? map.at(2, 1) : map.at(1, 2), 5.0F);
      QCOMPARE(is_exchanged ? map.at(0, 1) : map.at(1, 0), 3.0F);
    }
  }

  void wholeNumbers_areAMapByTheirName() {
    const auto write_as = [this](const std::string& name) {
      io::AtomicFile target(path("whole.h5"));
      io::Hdf5Output out(target);
      out.add_dataset<std::int32_t>(name, {2, 2}, "", "");
      const std::vector<std::int32_t> values{50, -125, 0, 100};
      out.write(name, {{0, 0}, {2, 2}}, values.data());
      out.close();
      target.commit();
    };
    write_as("disp_hundredths");
    const Estimate read = io::read_result(path("whole.h5"), kGrid);
    QCOMPARE(read.field.disparity.view(kGrid.center()).at(0, 1), -125.0F);
    write_as("classes");
    QVERIFY_THROWS_EXCEPTION(IoError, (void)io::read_result(path("whole.h5"), kGrid));
  }

  /// As netCDF and xarray write them.
  void statedMissingValues_areHonored() {
    for (const char* attribute : {"_FillValue", "missing_value"}) {
      io::AtomicFile target(path("stated.h5"));
      io::Hdf5Output out(target);
      out.add_dataset<float>("map", {2, 2}, "", "");
      const std::vector<float> values{0.5F, -999, 0, 1};
      out.write("map", {{0, 0}, {2, 2}}, values.data());
      out.set_number("map", attribute, -999.0);
      out.close();
      target.commit();

      const Estimate read = io::read_result(path("stated.h5"), kGrid);

      const DisparityView map = read.field.view(kGrid.center());
      QVERIFY(!map.is_valid(0, 1));
      QVERIFY(map.is_valid(0, 0) && map.is_valid(1, 0) && map.is_valid(1, 1));
    }
  }

  void statedAxesOfAllViews_areHonored() {
    std::vector<float> stored(2 * 3 * 5 * 3);
    std::iota(stored.begin(), stored.end(), 0.0F);
    for (const std::string name : {"map", "estimate/disparity"}) {
      write_stated(name, "x,y,u,v", {2, 3, 5, 3}, stored);
      const Estimate read = io::read_result(path("stated.h5"), kGrid);

      QCOMPARE(read.field.disparity.grid(), kGrid);
      QCOMPARE(read.field.disparity.height(), 3);
      QCOMPARE(read.field.disparity.view({1, 4}).at(2, 0), 2.0F * 15 + 4 * 3 + 1);
    }
  }

  void badResults_areRefused_data() {
    QTest::addColumn<QString>("file");
    QTest::addColumn<QString>("expected");
    QTest::newRow("missing") << "none.h5"
                             << "no such file";
    QTest::newRow("two maps") << "two.h5"
                              << "2 were found (a, b)";
    QTest::newRow("no map") << "rank.h5"
                            << "none was found";
    QTest::newRow("text") << "text.h5"
                          << "not an HDF5 file";
    QTest::newRow("unknown kind") << "map.xyz"
                                  << "not a disparity map";
    QTest::newRow("8-bit TIFF") << "grey.tiff"
                                << "32-bit float";
    QTest::newRow("folder") << "folder"
                            << "disp_maps";
    QTest::newRow("other grid") << "grid.h5"
                                << "does not fit";
    QTest::newRow("cut short") << "cut.h5"
                               << "truncated";
  }
  void badResults_areRefused() {
    QFETCH(QString, file);
    QFETCH(QString, expected);
    write_floats("two.h5", {{"a", {6, 7}}, {"b", {6, 7}}}, 1);
    write_floats("rank.h5", {{"a", {6, 7, 2}}}, 1);
    std::ofstream(path("text.h5")) << "hello";
    std::ofstream(path("map.xyz")) << "hello";
    io::write_png(path("grey.png"), Image<std::uint8_t>(3, 3).view());
    std::filesystem::rename(path("grey.png"), path("grey.tiff"));
    std::filesystem::create_directory(path("folder"));
    Estimate estimate;
    estimate.field = sample_field({9, 9}, {});
    io::write_result(path("grid.h5"), estimate, Progress(1));
    std::filesystem::copy_file(path("grid.h5"), path("cut.h5"));
    std::filesystem::resize_file(path("cut.h5"), 3000);

    try {
      (void)io::read_result(path(file.toStdString().c_str()), kGrid);
      QFAIL("the result was accepted");
    } catch (const IoError& error) {
      QVERIFY2(QString(error.what()).contains(expected), error.what());
      QVERIFY(QString(error.what()).contains(file));
    }
  }

  void cancelledWriting_leavesTheOldFile() {
    std::ofstream(path("r.h5")) << "old";
    Estimate estimate;
    estimate.field = sample_field(kGrid, {});
    std::stop_source stop;
    const Progress progress(
        stop.get_token(),
        [&](const ProgressState& state) {
          if (state.fraction > 0.1) stop.request_stop();
        },
        1);

    QVERIFY_THROWS_EXCEPTION(Cancelled, io::write_result(path("r.h5"), estimate, progress));
    QCOMPARE(text_of(path("r.h5")), std::string("old"));
    QCOMPARE(std::distance(std::filesystem::directory_iterator(path("")),
                           std::filesystem::directory_iterator()),
             1);
  }

  void ply_placesPointsByTheCamera_data() {
    QTest::addColumn<bool>("is_known");
    QTest::newRow("camera known") << true;
    QTest::newRow("camera unknown") << false;
  }
  void ply_placesPointsByTheCamera() {
    QFETCH(bool, is_known);
    DisparityField field = sample_field({1, 1}, {});
    std::fill_n(field.disparity.data(), field.disparity.size(), 1.0F);
    field.disparity.data()[1] = 2;
    const Image<std::uint8_t> rgba(kHeight, kWidth, 4, 200);
    CameraGrid camera;
    if (is_known) {
      camera.baseline = 10;
      camera.focal_length = 2;
      camera.shift = 1;
    }

    io::write_ply(path("c.ply"), make_point_cloud(field.view({0, 0}), camera, rgba),
                  io::PlyForm::Text);
    std::istringstream in(text_of(path("c.ply")));
    std::string line;
    while (std::getline(in, line) && line != "end_header") {
    }
    double x = 0, y = 0, z = 0;
    in >> x >> y >> z;

    // The first valid pixel is (y 0, x 1); nearer points have the larger z.
    if (is_known) {
      const double depth = 20.0 / 3;
      QVERIFY(std::abs(z + depth) < 1e-5);
      QVERIFY(std::abs(x - (1 - 3.0) * depth / 14) < 1e-5);
      QVERIFY(std::abs(y - 2.5 * depth / 14) < 1e-5);
    } else {
      QVERIFY(z > 0);
      QCOMPARE(x, -2.0);
      QCOMPARE(y, 2.5);
    }
  }

  void ply_withoutPointsIsRefused() {
    QVERIFY_THROWS_EXCEPTION(InvalidInput, io::write_ply(path("c.ply"), PointCloud{}));
    QVERIFY(!std::filesystem::exists(path("c.ply")));
  }
};

}  // namespace episcope::in_result_test

EPISCOPE_TEST(result_test, ResultTest)
#include "result_test.moc"
