// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/theme.h"
#include "tests/widgets/pictures.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/epi_pane.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/cloud/point_cloud_panel.h"
#include "widgets/controls/message_bar.h"
#include "widgets/controls/tool_button.h"
#include "widgets/panels/color_bar.h"
#include "widgets/panels/info_panel.h"
#include "widgets/panels/method_panel.h"
#include "widgets/panels/metric_table.h"
#include "widgets/panels/overlay_bar.h"
#include "widgets/panels/result_list.h"
#include "widgets/panels/value_bar.h"
#include "widgets/panels/view_grid.h"

#include <QAbstractButton>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QHeaderView>
#include <QLabel>
#include <QSplitter>
#include <QStyleOption>
#include <QVBoxLayout>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <memory>

namespace episcope::in_theme_test {

namespace {

/// WCAG 2.1 AA for text.
constexpr double kLegible = 4.5;

MethodDescription method() {
  ParameterDescription number{"inner", "Inner", "", "", 0.8, 0, 2, false, {}, {}};
  ParameterDescription range{"range", "Range", "", "", IntervalOrAuto{}, -2, 2, false, {}, {}};
  return {"m", "M", "", "", true, {number, range}};
}

QWidget* make_method_panel() {
  auto* panel = new MethodPanel;
  panel->setMethods({method()});
  return panel;
}

QWidget* make_job_panel() {
  auto* panel = new JobPanel;
  panel->addJob(1, "job");
  return panel;
}

int largest_difference(const QColor& a, const QColor& b) {
  return std::max({std::abs(a.red() - b.red()), std::abs(a.green() - b.green()),
                   std::abs(a.blue() - b.blue())});
}

}  // namespace

class ThemeTest : public QObject {
  Q_OBJECT

  void addPalettes() {
    QTest::addColumn<QPalette>("palette");
    QTest::newRow("light") << theme::light_palette();
    QTest::newRow("dark") << theme::dark_palette();
  }

 private slots:
  void contrast_knowsItsEnds() {
    QCOMPARE(theme::contrast_ratio(Qt::black, Qt::white), 21.0);
    QCOMPARE(theme::contrast_ratio(Qt::white, Qt::black), 21.0);
    QCOMPARE(theme::contrast_ratio(Qt::red, Qt::red), 1.0);
  }

  void longNamesOfAComboBox_endInAnEllipsis() {
    OutlinedStyle style;
    QComboBox box;
    box.setStyle(&style);
    box.setFixedSize(120, 28);
    QStyleOptionComboBox option;
    option.initFrom(&box);
    const int room =
        style.subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, &box)
            .width();
    const auto picture = [&](const QString& text) {
      box.clear();
      box.addItem(text);
      return box.grab().toImage();
    };
    const QImage drawn = picture(QString(80, 'a'));

    QString text = "…";
    while (picture(text) != drawn && box.fontMetrics().horizontalAdvance(text) < room) {
      text.prepend('a');
    }

    QCOMPARE(picture(text), drawn);
    QVERIFY(text.size() > 4 && box.fontMetrics().horizontalAdvance(text) <= room);
  }

  void drawnText_isLegible_data() { addPalettes(); }
  void drawnText_isLegible() {
    QFETCH(QPalette, palette);
    const QColor window = palette.color(QPalette::Window);

    for (const auto& color : {palette.color(QPalette::WindowText), theme::muted_text(palette),
                              theme::error_text(palette), theme::warning_text(palette),
                              theme::success_text(palette), palette.color(QPalette::Link)}) {
      QVERIFY2(theme::contrast_ratio(window, color) >= kLegible, qPrintable(color.name()));
    }
    QVERIFY(theme::contrast_ratio(palette.color(QPalette::Base), palette.color(QPalette::Text)) >=
            kLegible);
    QVERIFY(theme::contrast_ratio(palette.color(QPalette::Highlight),
                                  palette.color(QPalette::HighlightedText)) >= 4);
  }

  void canvasText_isLegible() {
    for (const auto& color : {theme::kCanvasText, theme::kCanvasMuted, theme::kEstimate,
                              theme::kTruth, theme::kMeasured, theme::kCrossHair}) {
      QVERIFY2(theme::contrast_ratio(theme::kCanvas, color) >= kLegible, qPrintable(color.name()));
    }
  }

  void uncheckedBoxes_areSeen_data() { addPalettes(); }
  void uncheckedBoxes_areSeen() {
    constexpr double kSeen = 3;  // WCAG 2.1 AA for controls
    QFETCH(QPalette, palette);
    OutlinedStyle style;
    QCheckBox box("box");
    box.setStyle(&style);
    box.setPalette(palette);
    box.setAutoFillBackground(true);
    box.resize(box.sizeHint());
    QStyleOptionButton option;
    option.initFrom(&box);

    const QImage drawn = box.grab().toImage();

    const QRect frame = style.subElementRect(QStyle::SE_CheckBoxIndicator, &option, &box);
    const QColor window = palette.color(QPalette::Window);
    for (const QPoint at :
         {QPoint(frame.left(), frame.center().y()), QPoint(frame.center().x(), frame.bottom())}) {
      const QColor color = drawn.pixelColor(at);
      QVERIFY2(theme::contrast_ratio(window, color) >= kSeen, qPrintable(color.name()));
    }
  }

  void splitterHandles_areSeenAndTouchNothing_data() { addPalettes(); }
  void splitterHandles_areSeenAndTouchNothing() {
    constexpr double kSeen = 3;  // WCAG 2.1 AA for controls
    QFETCH(QPalette, palette);
    OutlinedStyle style;
    QSplitter splitter(Qt::Vertical);
    for (int i = 0; i < 2; ++i) splitter.addWidget(new QWidget);
    splitter.resize(200, 100);
    for (QWidget* each :
         {static_cast<QWidget*>(&splitter), static_cast<QWidget*>(splitter.handle(1))}) {
      each->setStyle(&style);
      each->setPalette(palette);
      each->setAutoFillBackground(true);
    }
    splitter.show();

    const QImage drawn = splitter.handle(1)->grab().toImage();

    const QColor window = palette.color(QPalette::Window);
    const QColor middle = drawn.pixelColor(drawn.rect().center());
    QVERIFY2(theme::contrast_ratio(window, middle) >= kSeen, qPrintable(middle.name()));
    for (int x = 0; x < drawn.width(); ++x) {
      QCOMPARE(drawn.pixelColor(x, 0), window);
      QCOMPARE(drawn.pixelColor(x, drawn.height() - 1), window);
    }
  }

  void icons_areDrawnInTheTextColour_data() { addPalettes(); }
  void icons_areDrawnInTheTextColour() {
    QFETCH(QPalette, palette);
    QApplication::setPalette(palette);
    QVERIFY(!themed_icon("open").isNull());  // Registers the resources.
    const auto files = QDir(":/episcope/icons").entryList({"*.svg"});
    QVERIFY(files.size() > 15);

    for (const auto& file : files) {
      const QImage image = themed_icon(file.chopped(4)).pixmap(32, 32).toImage();
      int drawn = 0;
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
          const QColor color = image.pixelColor(x, y);
          if (color.alpha() < 255) continue;
          ++drawn;
          // Where the soft edges of two strokes meet, blending rounds twice.
          QVERIFY2(largest_difference(color, palette.color(QPalette::ButtonText)) <= 1,
                   qPrintable(file + " " + color.name()));
        }
      }
      QVERIFY2(drawn > 10, qPrintable(file));
    }
    QVERIFY(themed_icon("no such icon").isNull());
  }

  void everyControl_hasAnObjectName_data() {
    using Maker = std::function<QWidget*()>;
    QTest::addColumn<Maker>("make");
    QTest::newRow("ColorBar") << Maker([] { return new ColorBar; });
    QTest::newRow("EpiPane") << Maker([] { return new EpiPane(Qt::Horizontal); });
    QTest::newRow("InfoPanel") << Maker([] { return new InfoPanel; });
    QTest::newRow("JobPanel") << Maker(make_job_panel);
    QTest::newRow("MessageBar") << Maker([] { return new MessageBar; });
    QTest::newRow("MethodPanel") << Maker(make_method_panel);
    QTest::newRow("MetricTable") << Maker([] { return new MetricTable; });
    QTest::newRow("OverlayBar") << Maker([] { return new OverlayBar; });
    QTest::newRow("PointCloudPanel") << Maker([] { return new PointCloudPanel; });
    QTest::newRow("ResultList") << Maker([] { return new ResultList; });
    QTest::newRow("ValueBar") << Maker([] { return new ValueBar; });
    QTest::newRow("ViewCanvas") << Maker([] { return new ViewCanvas; });
    QTest::newRow("ViewGrid") << Maker([] { return new ViewGrid; });
  }

  void everyControl_hasAnObjectName() {
    QFETCH(std::function<QWidget*()>, make);

    const std::unique_ptr<QWidget> widget(make());

    QVERIFY(!widget->objectName().isEmpty());
    for (const auto* child : widget->findChildren<QWidget*>()) {
      const bool is_control = qobject_cast<const QAbstractButton*>(child) ||
                              qobject_cast<const QComboBox*>(child) ||
                              qobject_cast<const QAbstractSpinBox*>(child) ||
                              qobject_cast<const QAbstractSlider*>(child);
      // Parts that Qt makes inside of its own controls have no name of ours.
      const bool is_inner = child->parentWidget()->inherits("QAbstractScrollArea") ||
                            child->parentWidget()->inherits("QTableView") ||
                            child->objectName().startsWith("qt_") ||
                            child->parentWidget()->objectName().startsWith("qt_");
      if (is_control && !is_inner) {
        QVERIFY2(!child->objectName().isEmpty(), child->metaObject()->className());
      }
    }
  }

  void canvas_doesNotFollowTheDesktop_data() { addPalettes(); }
  void canvas_doesNotFollowTheDesktop() {
    QFETCH(QPalette, palette);
    QApplication::setPalette(palette);
    ViewCanvas canvas;
    canvas.resize(200, 150);

    QCOMPARE(canvas.grab().toImage().pixelColor(3, 3), QColor(theme::kCanvas));
  }

  void changedTheme_leavesNoTextBehind() {
    QApplication::setPalette(theme::light_palette());
    QWidget window;
    auto* layout = new QVBoxLayout(&window);
    auto* values = new ValueBar;
    auto* method = make_method_panel();
    auto* info = new InfoPanel;
    info->setInfo("scene", {{"key", "value", "checked"}}, {{"A warning."}});
    auto* jobs = make_job_panel();
    for (auto* widget :
         {static_cast<QWidget*>(values), method, static_cast<QWidget*>(info), jobs}) {
      layout->addWidget(widget);
    }
    window.show();

    QApplication::setPalette(theme::dark_palette());
    QTest::qWait(0);

    const QColor background = theme::dark_palette().color(QPalette::Window);
    for (const auto* label : window.findChildren<QLabel*>()) {
      const QColor color = label->palette().color(QPalette::WindowText);
      QVERIFY2(theme::contrast_ratio(background, color) >= kLegible,
               qPrintable(label->objectName() + ": " + label->text()));
    }
    QApplication::setPalette(theme::light_palette());
  }

  void messageBar_isTintedByTheTheme_data() { addPalettes(); }
  void messageBar_isTintedByTheTheme() {
    QFETCH(QPalette, palette);
    QApplication::setPalette(palette);
    MessageBar bar;
    bar.resize(400, 32);
    bar.showMessage(Severity::Error, "lf.h5 is truncated.");

    const QColor background = bar.grab().toImage().pixelColor(8, 3);

    QVERIFY(background != palette.color(QPalette::Window));
    QVERIFY(theme::contrast_ratio(background, palette.color(QPalette::WindowText)) >= kLegible);
  }
};

}  // namespace episcope::in_theme_test

EPISCOPE_WINDOW_TEST(theme_test, ThemeTest)
#include "theme_test.moc"
