// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/appearance.h"
#include "engine/core/finding.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/controls/labels.h"
#include "widgets/controls/text.h"

#include <fmt/format.h>

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAction>
#include <QComboBox>
#include <QCoreApplication>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QGroupBox>
#include <QKeySequence>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QRegularExpression>
#include <QSpinBox>
#include <QTabBar>
#include <QTranslator>

namespace episcope::in_translation_test {
namespace {

constexpr QChar kOpen(0x27e6);
constexpr QChar kClose(0x27e7);

/// What is left of a text without its wrapped parts, its tags and what needs no translation.
QString unwrapped(QString text) {
  text.remove(QChar(0x200b));
  static const QRegularExpression wrapped("⟦[^⟦⟧]*(⟧|$)");
  while (text.contains(wrapped)) text.remove(wrapped);
  static const QRegularExpression tags("<[^>]*>|--[a-z_-]+");
  // Methods, arrays of colors, paths, the name of the light field, the program, languages.
  static const QRegularExpression names(
      "\\b(EPI|ST|PLANE)_[A-Z_]+\\b|\\b(KZ02|NET|RGGB|GRBG|GBRG|BGGR)\\b|"
      "(/[\\w.-]+)+|\\blf\\.h5\\b|\\bedge\\b|Episcope|Deutsch|English");
  static const QRegularExpression keys(
      "\\b(Ctrl|Shift|Alt|Return|Enter|Backspace|Delete|Del|Esc|Space|Home|PgUp|PgDown|Up|Down|"
      "Left|Right|"
      "Tab|"
      "F[0-9]+)\\b");
  return text.remove(tags).remove(names).remove(keys);
}

bool has_word(const QString& text) {
  static const QRegularExpression word("[A-Za-z]{2,}");
  return unwrapped(text).contains(word);
}

class Walk {
 public:
  void see(const QString& place, const QString& text) {
    ++count_;
    if (has_word(text)) plain_ << place + ": " + text;
  }
  [[nodiscard]] const QStringList& plain() const { return plain_; }
  [[nodiscard]] int count() const { return count_; }

 private:
  QStringList plain_;
  int count_ = 0;
};

int shown(const QStringList& plain) {
  for (const QString& each : plain) qWarning("not translated: %s", qPrintable(each));
  return static_cast<int>(plain.size());
}

/// Texts that the engine composes of what it found in this light field are shown as they were made.
bool is_of_the_scene(const QObject& object) {
  static const QStringList names{"info.title",   "info.source",     "info.files",      "info.gain",
                                 "info.warning", "annotation.file", "method.reference"};
  return names.contains(object.objectName());
}

void see_items(Walk& walk, const QAbstractItemModel& model, const QModelIndex& parent) {
  for (int row = 0; row < model.rowCount(parent); ++row) {
    for (int column = 0; column < model.columnCount(parent); ++column) {
      const QModelIndex index = model.index(row, column, parent);
      walk.see("item", index.data().toString());
      walk.see("tip of an item", index.data(Qt::ToolTipRole).toString());
      if (column == 0) see_items(walk, model, index);
    }
  }
}

void see_view(Walk& walk, const QAbstractItemView& view) {
  if (!view.model()) return;
  const bool is_header = view.inherits("QHeaderView");
  if (is_header) return;
  see_items(walk, *view.model(), {});
  for (int column = 0; column < view.model()->columnCount(); ++column) {
    const QVariant header = view.model()->headerData(column, Qt::Horizontal);
    walk.see("header", header.toString());
    walk.see("tip of a header",
             view.model()->headerData(column, Qt::Horizontal, Qt::ToolTipRole).toString());
  }
}

void see_widget(Walk& walk, const QWidget& widget) {
  const QString name = QString("%1 %2").arg(widget.metaObject()->className(), widget.objectName());
  walk.see(name + " (tip)", widget.toolTip());
  walk.see(name + " (accessible)", widget.accessibleName());
  if (widget.isWindow()) walk.see(name + " (title)", widget.windowTitle());
  if (const auto* label = qobject_cast<const ElidedLabel*>(&widget)) {
    walk.see(name, label->fullText());
  } else if (const auto* text = qobject_cast<const QLabel*>(&widget)) {
    walk.see(name, text->text());
  }
  if (const auto* button = qobject_cast<const QAbstractButton*>(&widget)) {
    walk.see(name, button->text());
  }
  if (const auto* line = qobject_cast<const QLineEdit*>(&widget)) {
    walk.see(name, line->placeholderText());
  }
  if (const auto* group = qobject_cast<const QGroupBox*>(&widget)) walk.see(name, group->title());
  if (const auto* menu = qobject_cast<const QMenu*>(&widget)) walk.see(name, menu->title());
  if (const auto* spin = qobject_cast<const QSpinBox*>(&widget)) {
    walk.see(name, spin->prefix() + spin->suffix());
  }
  if (const auto* spin = qobject_cast<const QDoubleSpinBox*>(&widget)) {
    walk.see(name, spin->prefix() + spin->suffix());
  }
  if (const auto* tabs = qobject_cast<const QTabBar*>(&widget)) {
    for (int i = 0; i < tabs->count(); ++i) walk.see(name, tabs->tabText(i) + tabs->tabToolTip(i));
  }
  if (const auto* view = qobject_cast<const QAbstractItemView*>(&widget)) see_view(walk, *view);
}

Walk seen_of(const QWidget& window) {
  Walk walk;
  see_widget(walk, window);
  for (const QWidget* widget : window.findChildren<QWidget*>()) {
    if (!is_of_the_scene(*widget)) see_widget(walk, *widget);
  }
  for (const QAction* action : window.findChildren<QAction*>()) {
    const QString name = "action " + action->objectName();
    walk.see(name, action->text());
    walk.see(name + " (tip)", action->toolTip());
  }
  return walk;
}

}  // namespace

/// Wraps every text, but for what is put into its places, which has to be wrapped by itself. Notes
/// texts that German lacks, unless it was not compiled.
class Wrapper : public QTranslator {
 public:
  Wrapper() : has_german_(languages().contains("de")) {
    if (has_german_) has_german_ = german_.load(":/episcope/translations/de.qm");
  }
  [[nodiscard]] bool isEmpty() const override { return false; }
  [[nodiscard]] const QStringList& withoutGerman() const { return without_german_; }
  [[nodiscard]] QString translate(const char* context, const char* source,
                                  const char* disambiguation, int n) const override {
    QString text = QString::fromUtf8(source);
    const QLatin1String place(context);
    const bool is_of_program = place.startsWith(QLatin1String("episcope::")) &&
                               !place.startsWith(QLatin1String("episcope::in_"));
    if (has_german_ && is_of_program &&
        german_.translate(context, source, disambiguation, n).isNull() &&
        !is_composed(context, text)) {
      without_german_ << QString("%1: %2").arg(context, text);
    }
    // The names of keys are read back by Qt.
    static const QRegularExpression keys("^((Ctrl|Shift|Alt)\\+)+([A-Z0-9+-]|[A-Z][A-Za-z]+)$");
    if (QLatin1String(context) == QLatin1String("QShortcut") || keys.match(text).hasMatch()) {
      return text;
    }
    static const QRegularExpression places("(%[1-9])");
    text.replace(places, QString(kClose) + "\\1" + kOpen);
    return kOpen + text + kClose;
  }

 private:
  // Of numbers and names: what the window knows of them is looked up elsewhere.
  static bool is_composed(const char* context, const QString& text) {
    static const QRegularExpression data("[0-9]|\\.(h5|png)\\b|^rendering the scene ");
    return QLatin1String(context) == QLatin1String("episcope::Schema") && text.contains(data);
  }

  QTranslator german_;
  bool has_german_;
  mutable QStringList without_german_;
};

/// With a translation that wraps every text, no text of the window stands bare, and German has all
/// that were asked for.
class TranslationTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { QVERIFY(QCoreApplication::installTranslator(&wrapper_)); }
  void cleanupTestCase() {
    QCoreApplication::removeTranslator(&wrapper_);
    QCOMPARE(wrapper_.withoutGerman().join(" | "), QString());
  }
  void checker_findsBareWords();
  void everyText_isTranslated();
  void textsOfEveryMethod_areTranslated();
  void valuesOfFindings_areTranslated();
  void dialogs_areTranslated_data();
  void dialogs_areTranslated();

 private:
  Wrapper wrapper_;
};

void TranslationTest::checker_findsBareWords() {
  const QString open(kOpen);
  const QString close(kClose);
  QVERIFY(has_word("Open file"));
  QVERIFY(has_word(open + "Default " + close + "auto"));
  QVERIFY(!has_word(open + "Default " + open + "auto" + close + close));
  QVERIFY(!has_word(open + "Run" + close + " (Ctrl+Return), 9×9"));
  QVERIFY(!has_word("EPI_L"));
  QCOMPARE(tr("%1 px").arg(5),
           close.isEmpty() ? QString() : open + close + "5" + open + " px" + close);
}

void TranslationTest::everyText_isTranslated() {
  WindowFixture f;
  const Walk empty = seen_of(f.window);
  QCOMPARE(shown(empty.plain()), 0);

  f.openSmall();
  for (const Tab& tab : f.window.bench().frame.tabs()) {
    f.window.bench().frame.showTab(tab.id);
    const Walk walk = seen_of(f.window);
    QCOMPARE(shown(walk.plain()), 0);
    QVERIFY(walk.count() > 500);
  }
}

void TranslationTest::textsOfEveryMethod_areTranslated() {
  WindowFixture f;
  f.openSmall();
  auto* methods = f.window.findChild<QComboBox*>("method.combo");
  QVERIFY(methods && methods->count() > 5);
  for (int i = 0; i < methods->count(); ++i) {
    methods->setCurrentIndex(i);
    const Walk walk = seen_of(f.window);
    QCOMPARE(shown(walk.plain()), 0);
  }
}

void TranslationTest::valuesOfFindings_areTranslated() {
  const auto said = [](std::string_view text, const auto&... values) {
    return fmt::format(fmt::runtime(text), values...);
  };
  const std::string slopes = said(finding_text("order.slopes_agree"), 0.88, 9468);
  const std::string direction =
      said(finding_text("order.direction"), said(finding_text("sign.occlusion"), 747, 177, 93, 32));
  const std::string turned = said(finding_text("exif.all"), finding_text("exif.upside_down"), 4);
  const std::string part = said(finding_text("numbers.rows"), "0, 2 … 8");
  const std::string link =
      said(finding_text("dataset.left_out"), "_", finding_text("dataset.nothing"));
  const std::string empty =
      said(finding_text("dataset.left_out"), "_", finding_text("dataset.empty"));
  const std::string depth =
      said(finding_text("units.stored"), finding_text("units.as_stored"), -1, 2, 3, 4);
  const std::string poses =
      said(finding_text("format.grid"), said(finding_text("format.posed"), "_"));
  const std::string array = said(finding_text("dataset.array"), "5×5×96×128×3");
  for (const std::string& sentence :
       {slopes + "; " + direction, turned, part, link, empty, depth, poses, array}) {
    const QString words = finding_words(sentence);
    QVERIFY2(!has_word(words), qPrintable(words));
  }
}

void TranslationTest::dialogs_areTranslated_data() {
  QTest::addColumn<QByteArray>("command");
  for (const char* id : {"file.conventions", "help.keys", "help.palette", "help.about"}) {
    QTest::newRow(id) << QByteArray(id);
  }
}

void TranslationTest::dialogs_areTranslated() {
  QFETCH(QByteArray, command);
  WindowFixture f;
  f.openSmall();

  f.trigger(command.constData());

  QTRY_VERIFY(QApplication::activePopupWidget() || f.window.findChild<QDialog*>());
  int count = 0;
  for (const QDialog* dialog : f.window.findChildren<QDialog*>()) {
    if (!dialog->isVisible()) continue;
    ++count;
    const Walk walk = seen_of(*dialog);
    QCOMPARE(shown(walk.plain()), 0);
    QVERIFY(walk.count() > 3);
  }
  QCOMPARE(count, 1);
}

}  // namespace episcope::in_translation_test

EPISCOPE_WINDOW_TEST(translation_test, TranslationTest)
#include "translation_test.moc"
