// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/ray_superpixels.h"

#include "engine/core/error.h"
#include "tests/engine/labeling/rays/noisy_case.h"
#include "tests/test_main.h"

#include <map>
#include <memory>
#include <set>

namespace episcope::in_ray_superpixels_test {

namespace {

constexpr ViewIndex kCenter{2, 2}, kFirst{0, 0}, kLast{4, 4};
constexpr float kTolerance = 0.1F;

// Calls `visit(id, label)` for each ray of a view.
template <class Visit>
void for_rays(const RaySuperpixels& superpixels, const Scene& scene, ViewIndex view,
              const Visit& visit) {
  const auto ids = superpixels.ids().view(view);
  const auto labels = scene.truth->labels.view(view);
  for (std::size_t i = 0; i < ids.size(); ++i) visit(ids.data[i], labels.data[i]);
}

// The label that most pixels of each superpixel have in the center view.
std::map<int, std::int32_t> labels_of(const RaySuperpixels& superpixels, const Scene& scene) {
  std::map<int, std::map<std::int32_t, int>> counts;
  for_rays(superpixels, scene, kCenter, [&](int id, std::int32_t label) { ++counts[id][label]; });
  std::map<int, std::int32_t> most;
  for (const auto& [id, of_label] : counts) {
    most[id] =
        std::ranges::max_element(of_label, {}, [](const auto& each) { return each.second; })->first;
  }
  return most;
}

// Share of the pairs of rays of two views that see one point which both are in the region, or not.
double agreement(const RaySuperpixels& superpixels, const Scene& scene,
                 const std::vector<std::uint8_t>& region, ViewIndex from, ViewIndex to) {
  const auto own = superpixels.ids().view(from), other = superpixels.ids().view(to);
  const DisparityField& field = scene.truth->field;
  std::vector<std::int32_t> targets(static_cast<std::size_t>(own.width));
  int pairs = 0, equal = 0;
  for (int y = 0; y < own.height; ++y) {
    find_ray_targets(field.view(from), field.view(to), {to.v - from.v, to.u - from.u}, y,
                     targets.data());
    for (int x = 0; x < own.width; ++x) {
      if (targets[static_cast<std::size_t>(x)] < 0) continue;
      ++pairs;
      equal += region[own.at(y, x)] == region[other.data[targets[static_cast<std::size_t>(x)]]];
    }
  }
  return static_cast<double>(equal) / pairs;
}

}  // namespace

class RaySuperpixelsTest : public QObject {
  Q_OBJECT

 private slots:
  // The last view has no part in making the first one, and both show what the center view hides.
  void regions_areTheSameRaysInAllViews() {
    const Scene scene = test::render("demo");
    const RaySuperpixels superpixels(*scene.light_field, scene.truth->field, Progress());
    int regions = 0;
    for (const PixelIndex seed : {PixelIndex{20, 20}, {48, 48}, {70, 30}, {30, 75}}) {
      const auto region =
          superpixels.alike(superpixels.ids().view(kCenter).at(seed.y, seed.x), kTolerance);
      const double share = agreement(superpixels, scene, region, kFirst, kLast);
      QVERIFY2(share > 0.99, qPrintable(QString::number(share)));
      regions += std::ranges::count(region, 1) > 1;
    }
    QVERIFY(regions >= 2);
  }

  void superpixels_stayWithinObjects_inAllViews() {
    const Scene scene = test::render("demo");
    const RaySuperpixels superpixels(*scene.light_field, scene.truth->field, Progress());
    const auto most = labels_of(superpixels, scene);
    for (const ViewIndex view : {kCenter, kFirst, kLast}) {
      int right = 0, all = 0;
      for_rays(superpixels, scene, view, [&](int id, std::int32_t label) {
        const auto found = most.find(id);
        right += found != most.end() && found->second == label;
        ++all;
      });
      const double share = static_cast<double>(right) / all;
      // Superpixels of 8 px are coarse beside the objects of views of 96 px.
      QVERIFY2(share > 0.95, qPrintable(QString::number(share)));
    }
  }

  void superpixels_areConnectedInTheCenterView() {
    const Scene scene = test::render("demo");
    const RaySuperpixels superpixels(*scene.light_field, scene.truth->field, Progress());
    const auto ids = superpixels.ids().view(kCenter);
    Image<std::uint8_t> seen(ids.height, ids.width);
    std::set<int> begun;
    for (int y = 0; y < ids.height; ++y) {
      for (int x = 0; x < ids.width; ++x) {
        if (seen.at(y, x) != 0) continue;
        QVERIFY2(begun.insert(ids.at(y, x)).second, "a superpixel has two parts");
        std::vector<PixelIndex> open{{y, x}};
        while (!open.empty()) {
          const PixelIndex at = open.back();
          open.pop_back();
          if (at.y < 0 || at.x < 0 || at.y >= ids.height || at.x >= ids.width) continue;
          if (seen.at(at.y, at.x) != 0 || ids.at(at.y, at.x) != ids.at(y, x)) continue;
          seen.at(at.y, at.x) = 1;
          for (const PixelIndex step : {PixelIndex{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
            open.push_back({at.y + step.y, at.x + step.x});
          }
        }
      }
    }
    QVERIFY(begun.size() > 50);
  }

  void threads_doNotMatter() {
    const Scene scene = test::render("demo", 64);
    const RaySuperpixels one(*scene.light_field, scene.truth->field, Progress(1));
    const RaySuperpixels many(*scene.light_field, scene.truth->field, Progress(3));
    QVERIFY(std::equal(one.ids().data(), one.ids().data() + one.ids().size(), many.ids().data()));
  }

  void tolerance_widensRegions() {
    const Scene scene = test::render("demo");
    const RaySuperpixels superpixels(*scene.light_field, scene.truth->field, Progress());
    const std::uint16_t seed = superpixels.ids().view(kFirst).at(48, 48);

    const auto least = superpixels.alike(seed, 0);
    const auto more = superpixels.alike(seed, 0.3F);
    const auto most = superpixels.alike(seed, 2);

    QCOMPARE(std::ranges::count(least, 1), 1);
    QVERIFY(std::ranges::count(more, 1) > 1);
    for (std::size_t id = 0; id < more.size(); ++id) QVERIFY(more[id] <= most[id]);
    // Whatever the colors: jumps of disparity are not crossed.
    QVERIFY(std::ranges::count(most, 0) > 0);
    QCOMPARE(std::ranges::count(superpixels.alike(RaySuperpixels::kNone, 2), 1), 0);
  }

  // Gray 130 at the left and 150 at the right, which is within the tolerance.
  void edges_areNotCrossed_butSlopesAre() {
    const auto reaches_right = [](bool is_slope) {
      constexpr int kSide = 64;
      ViewStack<std::uint8_t> samples({3, 3}, kSide, kSide);
      for (std::size_t i = 0; i < samples.size(); ++i) {
        const int x = static_cast<int>(i) % kSide;
        samples.data()[i] = static_cast<std::uint8_t>(130 + (is_slope ? x / 3 : x < 32 ? 0 : 20));
      }
      const LightField light_field(LightField::Samples(std::move(samples)), {});
      const DisparityField flat{ViewStack<float>({3, 3}, kSide, kSide, 1, {}, allocate_large_zeros),
                                {}};
      const RaySuperpixels superpixels(light_field, flat, Progress());
      const auto ids = superpixels.ids().view({1, 1});
      return superpixels.alike(ids.at(32, 4), kTolerance)[ids.at(32, 60)] != 0;
    };
    QVERIFY(reaches_right(true));
    QVERIFY(!reaches_right(false));
  }

  void pixelsWithoutContent_haveNone() {
    Scene scene = test::render("demo", 48);
    const LightField& whole = *scene.light_field;
    ViewStack<std::uint8_t> valid(whole.grid(), 48, 48);
    std::fill_n(valid.data(), valid.size(), std::uint8_t{1});
    for (int i = 0; i < valid.grid().count(); ++i) {
      for (int y = 0; y < 6; ++y) std::fill_n(valid.view(valid.view_at(i)).row(y), 6, 0);
    }
    const auto samples = std::get<ViewStack<std::uint8_t>>(whole.samples()).clone();
    const LightField vignetted(LightField::Samples(samples.clone()), {}, std::move(valid));

    const RaySuperpixels superpixels(vignetted, scene.truth->field, Progress());

    for (const ViewIndex view : {kCenter, kLast}) {
      QCOMPARE(superpixels.ids().view(view).at(5, 5), RaySuperpixels::kNone);
      QVERIFY(superpixels.ids().view(view).at(6, 6) != RaySuperpixels::kNone);
    }
  }

  void disparityOfOneView_isNotEnough() {
    const Scene scene = test::render("demo", 32);
    DisparityField one{ViewStack<float>({1, 1}, 32, 32, 1, kCenter), {}};
    std::fill_n(one.disparity.data(), one.disparity.size(), 0.0F);
    QVERIFY_THROWS_EXCEPTION(InvalidInput, RaySuperpixels(*scene.light_field, one, Progress()));
  }
};

}  // namespace episcope::in_ray_superpixels_test

EPISCOPE_TEST(ray_superpixels_test, RaySuperpixelsTest)
#include "ray_superpixels_test.moc"
