// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/net_evidence.h"
#include "tests/engine/disparity/light_fields.h"
#include "tests/engine/disparity/net/net_vectors.h"
#include "tests/test_main.h"

#include <cmath>

namespace episcope::in_net_evidence_test {

using namespace episcope::test;

namespace {

// The logarithm of 0.003 and more passes on relative errors of sums in [0, 3], 3·10⁻⁷ / 0.003.
constexpr double kTolerance = 1e-4;

NetDisparity wanted(float disparity, int) {
  return {.map = nullptr, .same = disparity};
}
NetDisparity wanted(const Image<float>& map, int y) {
  return {.map = map.row(y)};
}

// Evidence of all rows at maps, or at disparities that all pixels share, one after the other.
template <class Disparity>
std::vector<std::vector<float>> all_evidence(const LightField& light_field, const Interval& range,
                                             const std::vector<Disparity>& disparities,
                                             int band = 5) {
  constexpr bool is_plane = std::is_same_v<Disparity, float>;
  NetEvidence evidence(light_field, light_field.center(), range,
                       is_plane ? NetEvidenceOf::Planes : NetEvidenceOf::Maps);
  const int row = light_field.width() * kNetEvidence;
  std::vector<std::vector<float>> all(
      disparities.size(), std::vector<float>(static_cast<std::size_t>(light_field.height()) * row));
  for (int y = 0; y < light_field.height(); ++y) {
    if (y % band == 0) {
      evidence.hold(y, std::min(y + band, light_field.height()), Progress());
    }
    std::vector<NetDisparity> asked;
    for (std::size_t i = 0; i < disparities.size(); ++i) {
      asked.push_back(wanted(disparities[i], y));
      asked.back().out = &all[i][static_cast<std::size_t>(y) * row];
    }
    evidence.compute(y, asked);
  }
  return all;
}

template <class Disparity>
std::vector<float> whole_evidence(const LightField& light_field, const Interval& range,
                                  const Disparity& disparity, int band = 5) {
  return all_evidence<Disparity>(light_field, range, {disparity}, band).front();
}

// Numbers of one pixel of evidence and of a vector [channel][layer][pixel].
double pixel_difference(const float* evidence, const NetVector& vector, int layer, int pixel) {
  double largest = 0;
  for (int c = 0; c < kNetEvidence; ++c) {
    const int at = (c * vector.length(1) + layer) * vector.length(2) + pixel;
    largest = std::max(largest, static_cast<double>(std::abs(evidence[c] - vector.values[at])));
  }
  return largest;
}

LightField masked(const LightField& from,
                  const std::function<bool(ViewIndex, int, int)>& is_valid) {
  const ViewStack<float> samples = float_samples(from);
  ViewStack<std::uint8_t> valid(from.grid(), from.height(), from.width());
  for (int i = 0; i < from.grid().count(); ++i) {
    const ViewIndex view = from.grid().view_at(i);
    for (int y = 0; y < from.height(); ++y) {
      for (int x = 0; x < from.width(); ++x) valid.view(view).at(y, x) = is_valid(view, y, x);
    }
  }
  return {samples.clone(), {}, std::move(valid)};
}

}  // namespace

class NetEvidenceTest : public QObject {
  Q_OBJECT

 private slots:
  void guide_isThatOfTheVectors();
  void planes_areThoseOfTheVectors();
  void maps_areThoseOfTheVectors();
  void sectors_areThoseOfTheVectors_data();
  void sectors_areThoseOfTheVectors();
  void planesAndMaps_agree();
  void severalAtOnce_areThoseOfEach();
  void sampleTypes_agree();
  void bands_changeNothing();
  void withoutViews_isTheConstant();
  void invalidPixels_doNotCount();
  void besideInvalidPixels_theOwnGreyCounts();
  void guideBesideInvalidPixels_isOneSided();
};

void NetEvidenceTest::guide_isThatOfTheVectors() {
  const NetVector guide = net_vector("guide"), pixels = net_vector("pixels");
  const LightField light_field = vector_light_field();

  const Image<float> found = net_guide(light_field, light_field.center());

  for (int i = 0; i < 8; ++i) {
    const int y = static_cast<int>(pixels.values[i]), x = static_cast<int>(pixels.values[8 + i]);
    for (int c = 0; c < kNetGuide; ++c) {
      QVERIFY(std::abs(found.at(y, x, c) - guide.values[c * 8 + i]) < 1e-6F);  // one rounding
    }
  }
}

void NetEvidenceTest::planes_areThoseOfTheVectors() {
  const NetVector vector = net_vector("evidence"), pixels = net_vector("pixels");
  const LightField light_field = vector_light_field();
  const Interval range = vector_range();

  for (int layer = 0; layer < 32; ++layer) {
    const auto d = static_cast<float>(range.min + range.length() * layer / 31);
    const std::vector<float> all = whole_evidence(light_field, range, d);
    for (int i = 0; i < 8; ++i) {
      const int at = static_cast<int>(pixels.values[i] * 32 + pixels.values[8 + i]);
      QVERIFY(pixel_difference(&all[at * kNetEvidence], vector, layer, i) < kTolerance);
    }
  }
}

void NetEvidenceTest::maps_areThoseOfTheVectors() {
  const NetVector vector = net_vector("hypothesis_evidence"), pixels = net_vector("pixels");
  const NetVector hypotheses = net_vector("hypotheses");
  const LightField light_field = vector_light_field();

  for (int layer = 0; layer < 8; ++layer) {
    Image<float> map(28, 32);
    std::copy_n(hypotheses.values.begin() + layer * 28 * 32, 28 * 32, map.begin());
    const std::vector<float> all = whole_evidence(light_field, vector_range(), map);
    for (int i = 0; i < 8; ++i) {
      const int at = static_cast<int>(pixels.values[i] * 32 + pixels.values[8 + i]);
      QVERIFY(pixel_difference(&all[at * kNetEvidence], vector, layer, i) < kTolerance);
    }
  }
}

void NetEvidenceTest::sectors_areThoseOfTheVectors_data() {
  QTest::addColumn<int>("views");
  for (const int views : {9, 17}) QTest::addRow("%d", views) << views;
}

void NetEvidenceTest::sectors_areThoseOfTheVectors() {
  QFETCH(const int, views);
  constexpr int kMost = kNetSectorViews;
  const LightField light_field =
      make_light_field({views, views}, 3, 3, 1, [](ViewIndex, int, int, int) { return 0.5F; });
  const NetVector chosen =
      net_vector("chosen_" + std::to_string(views) + "_" + std::to_string(kMost));
  const ViewIndex center = light_field.center();

  const auto sectors = net_sectors(light_field, center, nullptr);

  for (int k = 0; k < kNetSectors; ++k) {
    const auto count = static_cast<int>(sectors[k].size());  // 8 of 9×9 in a few sectors
    QVERIFY(count == kMost || count == 8);
    for (int i = 0; i < count; ++i) {
      const int at = 2 * (k * kMost + i);
      QCOMPARE(static_cast<float>(sectors[k][i].way.v), chosen.values[at]);
      QCOMPARE(static_cast<float>(sectors[k][i].way.u), chosen.values[at + 1]);
    }
  }
}

void NetEvidenceTest::planesAndMaps_agree() {
  const LightField light_field = vector_light_field();
  const float d = -0.61F;

  const std::vector<float> plane = whole_evidence(light_field, vector_range(), d);
  const std::vector<float> map =
      whole_evidence(light_field, vector_range(), Image<float>(28, 32, 1, d));

  QVERIFY(largest_difference(plane, map) < kTolerance);
}

// Rows longer than what is summed for at once, and samples outside the views at both ends.
void NetEvidenceTest::severalAtOnce_areThoseOfEach() {
  const LightField light_field =
      make_light_field({5, 5}, 7, 301, 3, [](ViewIndex view, int y, int x, int c) {
        return 0.5F + 0.4F * std::sin(1.3F * (x + view.u) + 0.7F * (y + view.v) + c);
      });
  const Interval range{-2, 2};
  const std::vector<float> planes{-2, -0.3F, 0, 1.7F};
  std::vector<Image<float>> maps;
  for (const float plane : planes) maps.emplace_back(7, 301, 1, plane);

  const auto of_planes = all_evidence(light_field, range, planes);
  const auto of_maps = all_evidence(light_field, range, maps);

  for (std::size_t i = 0; i < planes.size(); ++i) {
    QVERIFY(of_planes[i] == whole_evidence(light_field, range, planes[i]));
    QVERIFY(of_maps[i] == whole_evidence(light_field, range, maps[i]));
    // Maps round the coordinates of their samples, up to 301, to 1.5e-5 px.
    QVERIFY(largest_difference(of_planes[i], of_maps[i]) < 10 * kTolerance);
  }
}

void NetEvidenceTest::sampleTypes_agree() {
  const LightField bytes = vector_light_field();
  const LightField floats{float_samples(bytes), {}};
  const std::vector<float> expected = whole_evidence(bytes, vector_range(), -0.61F);

  QVERIFY(whole_evidence(floats, vector_range(), -0.61F) == expected);
  // k/255 is 257 k/65535, but for its rounding.
  QVERIFY(largest_difference(whole_evidence(as_uint16(bytes), vector_range(), -0.61F), expected) <
          kTolerance);
}

void NetEvidenceTest::bands_changeNothing() {
  const LightField light_field = vector_light_field();
  const Image<float> map = net_vector_map("map");

  const std::vector<float> whole = whole_evidence(light_field, vector_range(), map, 28);

  for (const int band : {1, 3, 16}) {
    QVERIFY(whole_evidence(light_field, vector_range(), map, band) == whole);
  }
}

void NetEvidenceTest::withoutViews_isTheConstant() {
  const LightField line =
      make_light_field({1, 5}, 6, 9, 1, [](ViewIndex, int, int x, int) { return 0.1F * x; });

  const std::vector<float> all = whole_evidence(line, {0, 0}, 0.0F);

  for (int k = 0; k < kNetSectors; ++k) {
    const bool has_views = k == 0 || k == 4;
    QCOMPARE(all[k] == 1.5F, !has_views);
    QCOMPARE(all[8 + k] == 1.5F, !has_views);
  }
}

void NetEvidenceTest::invalidPixels_doNotCount() {
  const LightField light_field = vector_light_field();
  const auto is_valid = [](ViewIndex view, int, int x) { return view.u != 4 || x < 16; };
  const LightField mask = masked(light_field, is_valid);
  const ViewStack<float> samples = float_samples(light_field);
  const auto sample = [&](ViewIndex view, int y, int x, int c) {
    return is_valid(view, y, x) ? samples.view(view).at(y, x, c) : 1;
  };
  const LightField spoilt = masked(like(light_field, sample), is_valid);

  const std::vector<float> all = whole_evidence(mask, vector_range(), 0.0F);

  QVERIFY(all == whole_evidence(spoilt, vector_range(), 0.0F));
}

void NetEvidenceTest::besideInvalidPixels_theOwnGreyCounts() {
  constexpr int kHole = 15;
  const LightField light_field = vector_light_field();
  const ViewIndex center = light_field.center();
  const LightField mask =
      masked(light_field, [&](ViewIndex view, int, int x) { return view == center || x != kHole; });
  const ViewStack<float> samples = float_samples(light_field);
  const LightField filled = like(light_field, [&](ViewIndex view, int y, int x, int c) {
    return samples.view(view).at(y, view != center && x == kHole ? kHole + 1 : x, c);
  });

  const auto at = [](const std::vector<float>& all, int y, int x, int width) {
    const auto first = all.begin() + (static_cast<long>(y) * width + x) * kNetEvidence;
    return std::vector<float>(first, first + kNetEvidence);
  };
  const int width = light_field.width();
  const Image<float> map(light_field.height(), width);
  for (const bool is_map : {false, true}) {
    const auto evidence_of = [&](const LightField& lf) {
      return is_map ? whole_evidence(lf, vector_range(), map)
                    : whole_evidence(lf, vector_range(), 0.0F);
    };
    const std::vector<float> found = evidence_of(mask), wanted = evidence_of(filled);
    QVERIFY(at(found, 9, kHole + 1, width) == at(wanted, 9, kHole + 1, width));
    for (const float none : at(found, 9, kHole, width)) QCOMPARE(none, 1.5F);
  }
}

void NetEvidenceTest::guideBesideInvalidPixels_isOneSided() {
  constexpr int kHole = 15, kRow = 9;
  const LightField light_field = vector_light_field();
  const ViewIndex center = light_field.center();
  const LightField mask = masked(light_field, [](ViewIndex, int, int x) { return x != kHole; });
  const ViewStack<float> samples = float_samples(light_field);
  const auto grey = [&](int x) {
    const float* const color = &samples.view(center).at(kRow, x, 0);
    return (color[0] + color[1] + color[2]) / 3;
  };

  const Image<float> guide = net_guide(mask, center);

  QCOMPARE(guide.at(kRow, kHole - 1, 3), 4 * (grey(kHole - 1) - grey(kHole - 2)));
  QCOMPARE(guide.at(kRow, kHole + 1, 3), 4 * (grey(kHole + 2) - grey(kHole + 1)));
}

}  // namespace episcope::in_net_evidence_test

EPISCOPE_TEST(net_evidence_test, NetEvidenceTest)
#include "net_evidence_test.moc"
