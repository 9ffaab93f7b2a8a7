// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/map_name.h"
#include "tests/test_main.h"

namespace episcope::in_map_name_test {

using io::MapKind;

class MapNameTest : public QObject {
  Q_OBJECT

 private slots:
  void words_tellTheKind_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<int>("kind");  // −1 = none
    const auto add = [](const char* name, MapKind kind) {
      QTest::newRow(name) << name << static_cast<int>(kind);
    };
    for (const char* name : {"1_1_disparity", "Disparity_01_01", "gt_disp_lowres_Cam007",
                             "gtDisp12", "lf_disparity_3_4", "DISPARITY"}) {
      add(name, MapKind::Disparity);
    }
    for (const char* name : {"1_1_depth", "DepthMap_3", "gt-depth"}) add(name, MapKind::Depth);
    for (const char* name : {"label", "5_5_label", "Labels_1_1", "segmentation_mask_04",
                             "objectids_lowres", "mask_label"}) {
      add(name, MapKind::Labels);
    }
    for (const char* name : {"valid_mask", "mask", "disparity_valid_1_1", "mask_center",
                             "mask_disparity", "mask_01_02"}) {
      add(name, MapKind::Valid);
    }
    add("invalid_3_3", MapKind::Invalid);
    add("mask_planes_lowres", MapKind::Region);
    add("object_mask", MapKind::Region);
    for (const char* name : {"1_1", "input_Cam000", "display_1", "out_03_04", "maskenball_3"}) {
      QTest::newRow(name) << name << -1;
    }
  }
  void words_tellTheKind() {
    QFETCH(QString, name);
    QFETCH(int, kind);

    const auto found = io::map_kind(name.toStdString());

    QCOMPARE(found ? static_cast<int>(*found) : -1, kind);
  }

  void words_tellWhatIsTrue_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<int>("claim");
    const auto add = [](const char* name, io::MapClaim claim) {
      QTest::newRow(name) << name << static_cast<int>(claim);
    };
    for (const char* name : {"gt_disparity", "disparityTrue", "Ground_Truth", "gtDisp_05",
                             "disparity_gt_raw", "gt_disp_lowres_Cam007"}) {
      add(name, io::MapClaim::True);
    }
    for (const char* name : {"disparity", "disp_map", "1_1_depth"}) add(name, io::MapClaim::None);
    for (const char* name :
         {"disparity_local", "5_5_disparity_estimated", "disp_est", "gt_disparity_error",
          "disparity_raw", "disparity_epi_l", "disparity_confidence"}) {
      add(name, io::MapClaim::Computed);
    }
  }
  void words_tellWhatIsTrue() {
    QFETCH(QString, name);
    QFETCH(int, claim);

    QCOMPARE(static_cast<int>(io::map_claim(name.toStdString())), claim);
  }

  void region_isNamedAfterItsMask() {
    QCOMPARE(io::region_name("planes_mask"), std::string("planes"));
    QCOMPARE(io::region_name("object_mask_03_03"), std::string("object"));
    QCOMPARE(io::region_name("mask_layer2"), std::string("layer2"));
    QCOMPARE(io::region_name("disparity_mask"), std::string());
    QCOMPARE(io::region_name("mask_planes_lowres"), std::string("planes"));
    QCOMPARE(io::region_name("mask_fine_surrounding"), std::string("fine_surrounding"));
    QCOMPARE(io::region_name("mask_4_4"), std::string());
    QCOMPARE(io::region_name("planes"), std::string());
  }

  void numbers_areTakenOutOfNames() {
    const io::NumberedName name = io::numbered_name("LF_03_012-20210314151617.PNG");

    QCOMPARE(name.text, std::string("lf_#_#-#.png"));
    QCOMPARE(name.numbers, (std::vector<long>{3, 12, 314151617}));
  }
};

}  // namespace episcope::in_map_name_test

EPISCOPE_TEST(map_name_test, MapNameTest)

#include "map_name_test.moc"
