// SPDX-License-Identifier: BSD-3-Clause
// The pictures that the window exports are those of `show`, pixel for pixel.
#include "app/gui/annotate/label_exchange.h"
#include "app/gui/annotate/segment_controller.h"
#include "app/gui/compare/picture_export.h"
#include "tests/app/gui/agreement/command_line.h"
#include "tests/app/gui/agreement/sample_scene.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/view_canvas.h"

#include <QFile>

#include <algorithm>
#include <array>
#include <vector>

namespace episcope::in_pictures_test {

namespace {

using render::Quantity;
using render::Subject;

bool is_same_picture(const QString& a, const QString& b) {
  const QImage left(a);
  const QImage right(b);
  return !left.isNull() && left.convertToFormat(QImage::Format_RGBA8888) ==
                               right.convertToFormat(QImage::Format_RGBA8888);
}

/// Whether it is compared over the view as well: one of each way of drawing.
bool is_checked_over_view(Quantity quantity) {
  constexpr std::array kChecked = {Quantity::Disparity,    Quantity::SignedError,
                                   Quantity::TrueLabels,   Quantity::Difference,
                                   Quantity::Segmentation, Quantity::WrongLabels};
  return std::ranges::find(kChecked, quantity) != kChecked.end();
}

/// The window and what `show` says of the same maps.
class Showing : public AgreementFixture {
 public:
  using AgreementFixture::AgreementFixture;

  /// What differs, or is on one side alone, for a quantity in the view that is looked at.
  [[nodiscard]] QString difference(Quantity quantity) {
    const QString id = render::info_of(quantity).id;
    const bool is_in_window = choose(quantity);
    const CommandLineRun of_map = show(quantity, {}, "show.png");
    if (is_in_window != (of_map.exit_code == 0)) {
      return id + (is_in_window ? " is refused: " + of_map.error : " is in no window") + where();
    }
    if (!is_in_window) return {};
    const QString map = path("map.png");
    const QString over = path("over.png");
    for (const QString& file : {map, over}) QFile::remove(file);
    save_map_picture(window.bench(), map);
    save_picture(window.bench(), over);
    if (!waitForFile(map) || !waitForFile(over)) return id + " was not exported" + where();
    if (!is_same_picture(map, path("show.png"))) return id + " differs" + where();
    if (!is_checked_over_view(quantity)) return {};
    return is_over_view_same(quantity, over) ? QString() : id + " over the view differs" + where();
  }

  void look(ViewIndex view) {
    session().set_view(view);
    QCoreApplication::processEvents();  // the canvas follows one turn later
  }

  void segment() {
    trigger("annotate.mode");
    trigger("segment.update");
    QTRY_VERIFY_WITH_TIMEOUT(isSegmented(), kPatience);
    labels_ = path("labels.h5");
    export_labels(window.bench(), find<SegmentController>(window), labels_,
                  {LabelTarget::Kind::Hdf5WithProbabilities});
    QVERIFY(waitForFile(labels_));
  }

 private:
  [[nodiscard]] QString where() { return " in view " + QString::fromStdString(view_text(view())); }

  [[nodiscard]] bool is_over_view_same(Quantity quantity, const QString& over) {
    const QString opacity = QString::number(canvas()->overlayOpacity(), 'g', 17);
    const CommandLineRun run = show(quantity, {"--over-view", opacity}, "show_over.png");
    return run.exit_code == 0 && is_same_picture(over, path("show_over.png"));
  }

  /// Whether there is such a map.
  bool choose(Quantity quantity) {
    Overlay& overlay = window.bench().overlay;
    if (quantity == Quantity::Difference) {
      overlay.setQuantity(Quantity::Disparity);
      overlay.setDifference(true);
    } else {
      if (!overlay.isAvailable(quantity)) return false;
      overlay.setQuantity(quantity);
    }
    const auto has_map = [&] { return overlay.sourceOf(overlay.choice()).has_value(); };
    // Errors are computed when they are asked for.
    const auto is_known = [&] { return has_map() || !session().is_evaluating(); };
    return QTest::qWaitFor(is_known, kPatience) && has_map();
  }

  /// What `show` is given for a quantity: what the window exports of it.
  [[nodiscard]] QStringList subject(Quantity quantity) {
    switch (render::info_of(quantity).subject) {
      case Subject::LightField:
      case Subject::Truth:
      case Subject::TrueLabels:
        return input();
      case Subject::Result:
      case Subject::Error:
        return {exported(first())};
      case Subject::ResultPair:
        return {exported(first()), "--minus", exported(second())};
      case Subject::Segmentation:
        break;
    }
    if (quantity == Quantity::Edges) return {exported(first())};
    const QString file = labels_.isEmpty() ? "none.h5" : labels_;
    if (quantity != Quantity::Probability) return {file};
    return {file, "--label", QString::number(window.bench().labels.current())};
  }

  CommandLineRun show(Quantity quantity, const QStringList& options, const char* name) {
    const QString place = QString("%1,%2").arg(view().v).arg(view().u);
    return run_command_line(QStringList("show") + subject(quantity) + options +
                                QStringList{"-o", name, "--overwrite", "--what",
                                            render::info_of(quantity).id, "--view", place},
                            path("."));
  }

  QString labels_;
};

const std::vector<Quantity>& maps_of_a_scene() {
  static const std::vector<Quantity> maps = [] {
    std::vector<Quantity> found;
    for (const auto& info : render::quantities()) {
      const bool is_map = info.quantity != Quantity::View && info.subject != Subject::Segmentation;
      if (is_map) found.push_back(info.quantity);
    }
    return found;
  }();
  return maps;
}

}  // namespace

class PicturesTest : public QObject {
  Q_OBJECT

 private slots:
  void maps_areThoseOfShow_data();
  void maps_areThoseOfShow();
  void view_isThatOfShow();
  void segmentation_isThatOfShow();
};

void PicturesTest::maps_areThoseOfShow_data() {
  QTest::addColumn<const SampleScene*>("sample");
  for (const SampleScene& sample : sample_scenes()) {
    if (sample.is_drawn) QTest::newRow(sample.name) << &sample;
  }
}

void PicturesTest::maps_areThoseOfShow() {
  QFETCH(const SampleScene*, sample);
  Showing f(*sample);
  QStringList differences;

  std::vector<ViewIndex> views{f.view()};
  if (sample->grid.count() > 1) views.push_back({0, 1});
  for (const ViewIndex view : views) {
    f.look(view);
    for (const Quantity quantity : maps_of_a_scene()) {
      const QString text = f.difference(quantity);
      if (!text.isEmpty()) differences << text;
    }
  }

  QVERIFY2(differences.isEmpty(), qPrintable('\n' + differences.join('\n')));
}

void PicturesTest::view_isThatOfShow() {
  Showing f(sample_scenes().front());
  f.window.bench().overlay.setQuantity(Quantity::View);
  save_picture(f.window.bench(), f.path("view.png"));
  QVERIFY(f.waitForFile(f.path("view.png")));

  const CommandLineRun run = run_command_line(
      QStringList{"show", "-o", "show.png", "--what", "view"} + f.input(), f.path("."));

  QVERIFY2(run.exit_code == 0, qPrintable(run.error));
  QVERIFY(is_same_picture(f.path("view.png"), f.path("show.png")));
}

void PicturesTest::segmentation_isThatOfShow() {
  for (const SampleScene& sample : {sample_scenes().front(), sample_scenes().back()}) {
    Showing f(sample);
    f.look({1, 3});
    f.segment();
    QStringList differences;
    for (const Quantity quantity :
         {Quantity::Segmentation, Quantity::Probability, Quantity::Uncertainty, Quantity::Edges,
          Quantity::WrongLabels}) {
      const QString text = f.difference(quantity);
      if (!text.isEmpty()) differences << text;
    }
    QVERIFY2(differences.isEmpty(),
             qPrintable(QString(sample.name) + ":\n" + differences.join('\n')));
  }
}

}  // namespace episcope::in_pictures_test

EPISCOPE_WINDOW_TEST(pictures_test, PicturesTest)
#include "pictures_test.moc"
