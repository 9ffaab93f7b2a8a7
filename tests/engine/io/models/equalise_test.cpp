// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/assemble_scene.h"
#include "tests/engine/io/synthetic_scene.h"
#include "tests/test_main.h"

#include <algorithm>
#include <cmath>

namespace episcope::in_equalise_test {

using namespace episcope::test;

namespace {

// A textured plane whose views have the gain 1 − 0.04·u + 0.02·v about the center view.
ViewStack<std::uint8_t> uneven_views(const Scene& scene) {
  ViewStack<std::uint8_t> views = bytes_of(scene).clone();
  for (int i = 0; i < views.grid().count(); ++i) {
    const ViewIndex view = views.view_at(i);
    const double gain = 1 - 0.04 * (view.u - 2) + 0.02 * (view.v - 2);
    std::uint8_t* const samples = views.view(view).data;
    std::transform(samples, samples + views.view_size(), samples, [=](std::uint8_t sample) {
      return static_cast<std::uint8_t>(std::clamp(gain * sample + 0.5, 0.0, 255.0));
    });
  }
  return views;
}

Scene opened(ViewStack<std::uint8_t> views, const io::OpenOptions& options,
             ViewStack<std::uint8_t> valid = {}) {
  Scene scene;
  io::SceneParts parts;
  parts.samples = std::move(views);
  parts.valid = std::move(valid);
  io::assemble(std::move(parts), options, scene, Progress(2));
  return scene;
}

bool warns(const Scene& scene) {
  return std::ranges::any_of(scene.convention.warnings, [](const std::string& warning) {
    return warning.find("--equalize") != std::string::npos;
  });
}

double mean_of(ImageView<const std::uint8_t> view) {
  double sum = 0;
  for (std::size_t i = 0; i < view.size(); ++i) sum += view.data[i];
  return sum / static_cast<double>(view.size());
}

}  // namespace

class EqualiseTest : public QObject {
  Q_OBJECT

 private slots:
  void unevenViews_areReportedAndLeftAlone() {
    const Scene plane = plane_scene({.height = 96, .width = 96});

    const Scene read = opened(uneven_views(plane), {});

    QVERIFY2(warns(read), describe(read.convention).c_str());
    // The corners with 1 ± 0.12.
    QVERIFY2(read.convention.gain.find("(view 4,0: 1.1") != std::string::npos ||
                 read.convention.gain.find("(view 0,4: 0.8") != std::string::npos,
             read.convention.gain.c_str());
    const auto& samples = std::get<ViewStack<std::uint8_t>>(read.light_field->samples());
    const ViewStack<std::uint8_t> before = uneven_views(plane);
    QVERIFY(std::equal(before.data(), before.data() + before.size(), samples.data()));
  }

  void unevenViews_canBeKeptFromMethods() {
    const Scene plane = plane_scene({.height = 96, .width = 96});

    const Scene read = opened(uneven_views(plane), {.keep_brightness = true});

    QVERIFY(read.light_field->info().reading.find("no-equalize") != nullptr);
    QVERIFY2(read.convention.gain.starts_with("differs"), read.convention.gain.c_str());
  }

  void unevenViews_areEvenedOutOnRequest() {
    const Scene plane = plane_scene({.height = 96, .width = 96});

    const Scene read = opened(uneven_views(plane), {.equalize = true});

    QVERIFY2(!warns(read), describe(read.convention).c_str());
    QVERIFY2(read.convention.gain.starts_with("evened out"), read.convention.gain.c_str());
    QVERIFY(read.light_field->info().reading.find("equalize") != nullptr);
    for (int i = 0; i < 25; ++i) {
      const ViewIndex view = read.light_field->grid().view_at(i);
      const double ratio =
          mean_of(read.light_field->view<std::uint8_t>(view)) / mean_of(bytes_of(plane).view(view));
      QVERIFY2(std::abs(ratio - 1) < 0.01, qPrintable(QString::number(ratio)));
    }
  }

  void evenViews_stayAsTheyAre() {
    const Scene plane = plane_scene({.height = 96, .width = 96});

    const Scene read = opened(bytes_of(plane).clone(), {.equalize = true});

    QVERIFY2(!warns(read), describe(read.convention).c_str());
    QVERIFY(has_same_samples(plane, read));
  }

  void mask_isReversedWithTheViews() {
    const Scene plane = plane_scene();
    ViewStack<std::uint8_t> valid({5, 5}, 64, 80);
    std::fill_n(valid.data(), valid.size(), std::uint8_t{1});
    valid.view({1, 0}).at(7, 9) = 0;

    const Scene read = opened(bytes_of(plane).clone(), {.flip = io::Flip::U}, std::move(valid));

    QVERIFY(!read.light_field->is_valid({1, 4}, 7, 9));
    QVERIFY(read.light_field->is_valid({1, 0}, 7, 9));
  }

  void samples_areDescribed() {
    const Scene plane = plane_scene();

    QVERIFY(opened(bytes_of(plane).clone(), {}).convention.samples.find("value/255") !=
            std::string::npos);
  }
};

}  // namespace episcope::in_equalise_test

EPISCOPE_TEST(equalise_test, EqualiseTest)
#include "equalise_test.moc"
