// SPDX-License-Identifier: BSD-3-Clause
#include "tests/test_main.h"

#include <QDir>
#include <QFile>
#include <QRegularExpression>
#include <QSet>
#include <QXmlStreamReader>

namespace episcope::in_translation_files_test {
namespace {

struct Message {
  QString context;
  QString source;
  QStringList translations;  ///< One, or one for each plural form.
  QString type;              ///< Empty if it is finished.
};

QList<Message> messages_of(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return {};
  QXmlStreamReader xml(&file);
  QList<Message> messages;
  QString context;
  bool has_forms = false;
  while (xml.readNext() != QXmlStreamReader::Invalid && !xml.atEnd()) {
    if (!xml.isStartElement()) continue;
    if (xml.name() == u"name") context = xml.readElementText();
    if (xml.name() == u"message") {
      messages.push_back({context, {}, {}, {}});
      has_forms = xml.attributes().value("numerus") == u"yes";
    }
    if (xml.name() == u"source") messages.back().source = xml.readElementText();
    if (xml.name() == u"translation") {
      messages.back().type = xml.attributes().value("type").toString();
      if (!has_forms) messages.back().translations << xml.readElementText();
    }
    if (xml.name() == u"numerusform") messages.back().translations << xml.readElementText();
  }
  return xml.hasError() ? QList<Message>() : messages;
}

QStringList sorted_matches(const QString& text, const QRegularExpression& pattern) {
  QStringList matches;
  for (auto match = pattern.globalMatch(text); match.hasNext();) matches << match.next().captured();
  matches.sort();
  return matches;
}

// What a program fills in or a widget reads: places, tags, patterns of file names.
QStringList placeholders(const QString& text) {
  static const QRegularExpression pattern(
      "%L?[1-9]|%n|</?[a-z]+>|\\{[a-z]+\\}|\\([^()]*\\*[^()]*\\)|\\[\\*\\]|--[a-z-]+");
  return sorted_matches(text, pattern);
}

// One that a menu underlines; "&&" is an ampersand.
int mnemonics(QString text) {
  return static_cast<int>(text.remove("&&").count('&'));
}

// White space at the ends, and what says that a dialog follows or that a sentence ends.
QString ends(const QString& text) {
  static const QRegularExpression pattern("^(\\s*).*?([…:.]?\\s*)$",
                                          QRegularExpression::DotMatchesEverythingOption);
  const auto match = pattern.match(text);
  return match.captured(1) + '|' + match.captured(2);
}

QString shown(const Message& message) {
  return QString("%1: “%2” → “%3”")
      .arg(message.context, message.source, message.translations.join(" | "));
}

}  // namespace

class TranslationFilesTest : public QObject {
  Q_OBJECT

 private slots:
  void checks_findWhatIsWrong();
  void everyText_isTranslated_data() { addFiles(); }
  void everyText_isTranslated();
  void placeholders_areKept_data() { addFiles(); }
  void placeholders_areKept();
  void mnemonicsAndEnds_areKept_data() { addFiles(); }
  void mnemonicsAndEnds_areKept();
  void oneTextOfAContext_isTranslatedOnce_data() { addFiles(); }
  void oneTextOfAContext_isTranslatedOnce();

 private:
  static void addFiles() {
    QTest::addColumn<QString>("path");
    const QDir folder(EPISCOPE_TRANSLATIONS);
    for (const QString& name : folder.entryList({"*.ts"})) {
      QTest::newRow(qPrintable(name)) << folder.filePath(name);
    }
  }
};

void TranslationFilesTest::checks_findWhatIsWrong() {
  QVERIFY(placeholders("%1 of %2") == placeholders("von %2 das %1"));
  QVERIFY(placeholders("%1 of %2") != placeholders("%1 von"));
  QVERIFY(placeholders("Images (*.png *.tif);;All files (*)") !=
          placeholders("Bilder (*.png);;Alle Dateien (*)"));
  QVERIFY(placeholders("<b>%1</b>") != placeholders("<b>%1<b>"));
  QCOMPARE(mnemonics("R&un && stop"), 1);
  QVERIFY(ends("Open…") != ends("Öffnen"));
  QVERIFY(ends(" px") != ends("px"));
  QVERIFY(ends("Done.") == ends("Fertig."));
}

void TranslationFilesTest::everyText_isTranslated() {
  QFETCH(QString, path);
  const QList<Message> messages = messages_of(path);
  QVERIFY(!messages.isEmpty());
  for (const Message& message : messages) {
    QVERIFY2(message.type.isEmpty(), qPrintable(message.type + ' ' + shown(message)));
    for (const QString& text : message.translations)
      QVERIFY2(!text.isEmpty(), qPrintable(shown(message)));
  }
}

void TranslationFilesTest::placeholders_areKept() {
  QFETCH(QString, path);
  for (const Message& message : messages_of(path)) {
    for (const QString& text : message.translations) {
      QVERIFY2(placeholders(message.source) == placeholders(text), qPrintable(shown(message)));
    }
  }
}

void TranslationFilesTest::mnemonicsAndEnds_areKept() {
  QFETCH(QString, path);
  for (const Message& message : messages_of(path)) {
    for (const QString& text : message.translations) {
      QVERIFY2(mnemonics(message.source) == mnemonics(text), qPrintable(shown(message)));
      if (message.context.startsWith("episcope")) {
        QVERIFY2(ends(message.source) == ends(text), qPrintable(shown(message)));
      }
    }
  }
}

void TranslationFilesTest::oneTextOfAContext_isTranslatedOnce() {
  QFETCH(QString, path);
  QSet<QString> seen;
  for (const Message& message : messages_of(path)) {
    const QString key = message.context + '|' + message.source;
    QVERIFY2(!seen.contains(key), qPrintable(shown(message)));
    seen.insert(key);
  }
}

}  // namespace episcope::in_translation_files_test

EPISCOPE_CORE_TEST(translation_files_test, TranslationFilesTest)
#include "translation_files_test.moc"
