// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/manual_window.h"

#include "widgets/controls/layout.h"
#include "widgets/controls/theme.h"

#include <QCoreApplication>
#include <QDialog>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QShortcut>
#include <QStandardPaths>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextDocument>
#include <QUrl>

#include <algorithm>

namespace episcope {
namespace {

struct ManualWindowText {
  Q_DECLARE_TR_FUNCTIONS(episcope::ManualWindow)
};

constexpr QSize kFirstSize(860, 720);
constexpr const char* kContents = "index.md";
constexpr const char* kSearch = "search";  // scheme of a page of hits
constexpr int kHitsOfAPage = 3;

QString text_of(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

// Links and emphasis would reach into what is cut out of a paragraph.
QString plain(const QString& markdown) {
  QTextDocument document;
  document.setMarkdown(markdown);
  return document.toPlainText().simplified();
}

bool has_all(const QString& text, const QStringList& words) {
  return std::ranges::all_of(
      words, [&](const QString& word) { return text.contains(word, Qt::CaseInsensitive); });
}

// The first paragraphs of a page that have all words, as a list; empty if none has.
QString hits_in(const QString& path, const QStringList& words) {
  static const QRegularExpression between("\n\n|\n(?=[-|])");  // also items and rows
  const QStringList paragraphs = text_of(path).split(between);
  QString hits;
  int count = 0;
  for (const QString& each : paragraphs) {
    if (count == kHitsOfAPage || !has_all(each, words)) continue;
    const QString text = plain(each);
    const auto at = std::max<qsizetype>(text.indexOf(words.front(), 0, Qt::CaseInsensitive), 0);
    constexpr qsizetype kBefore = 60, kLength = 220;
    hits +=
        "- … " + text.mid(std::max<qsizetype>(at - kBefore, 0), kLength).toHtmlEscaped() + " …\n";
    ++count;
  }
  if (hits.isEmpty()) return {};
  const QString title = plain(paragraphs.front().section('\n', 0, 0));
  return QString("### [%1](%2)\n\n%3\n").arg(title, QUrl::fromLocalFile(path).toString(), hits);
}

// A page that lists where the words are.
QString hits_of(const QString& typed) {
  const QStringList words = typed.split(' ', Qt::SkipEmptyParts);
  QString hits;
  const QFileInfoList pages = QDir(manual_folder()).entryInfoList({"*.md"}, QDir::Files);
  for (const QFileInfo& page : pages) hits += hits_in(page.filePath(), words);
  if (hits.isEmpty()) hits = ManualWindowText::tr("No paragraph has all of these words.");
  return "# " + ManualWindowText::tr("Search: %1").arg(typed.toHtmlEscaped()) + "\n\n" + hits;
}

/// Also makes the pages of hits, so that one can go back to them.
class Pages : public QTextBrowser {
 public:
  using QTextBrowser::QTextBrowser;
  QVariant loadResource(int type, const QUrl& name) override {
    if (name.scheme() == kSearch) return hits_of(name.path(QUrl::FullyDecoded)).toUtf8();
    return QTextBrowser::loadResource(type, name);
  }
};

}  // namespace

QString manual_folder() {
  QStringList shares;
  for (QDir folder(QCoreApplication::applicationDirPath()); !folder.isRoot(); folder.cdUp()) {
    shares << folder.filePath("share");
  }
  shares << QStandardPaths::standardLocations(QStandardPaths::GenericDataLocation);
  for (const QString& share : shares) {
    const QDir pages(share + "/episcope/manual");
    if (pages.exists(kContents)) return pages.canonicalPath();
  }
  return {};
}

/// Shows pages of the manual, which are Markdown, follows their links, goes back, and lists the
/// paragraphs that have all words of a search. Pages of the web open in the browser. Does not
/// block.
class ManualWindow : public QDialog {
  Q_OBJECT

 public:
  explicit ManualWindow(QWidget* parent)
      : QDialog(parent),
        pages_(named("manual.pages", new Pages(this))),
        words_(named("manual.search", new QLineEdit(this))) {
    setObjectName("manual");
    pages_->setAccessibleName(tr("Page of the manual"));
    pages_->setOpenExternalLinks(true);
    auto* contents = named("manual.contents", new QPushButton(tr("Contents"), this));
    auto* back = named("manual.back", new QPushButton(tr("Back"), this));
    back->setEnabled(false);
    auto* row = new QHBoxLayout;
    for (auto* button : {contents, back}) {
      button->setAutoDefault(false);
      row->addWidget(button);
    }
    words_->setPlaceholderText(tr("Search the manual"));
    words_->setAccessibleName(words_->placeholderText());
    words_->setClearButtonEnabled(true);
    row->addWidget(words_, 1);
    make_column(this, {row, {pages_, 1}}, {.margins = kStyleMargins, .spacing = theme::kSpacing});
    connect(contents, &QPushButton::clicked, this, [this] { open(kContents); });
    connect(back, &QPushButton::clicked, pages_, &QTextBrowser::backward);
    connect(pages_, &QTextBrowser::backwardAvailable, back, &QPushButton::setEnabled);
    connect(words_, &QLineEdit::returnPressed, this, &ManualWindow::search);
    connect(new QShortcut(QKeySequence::Find, this), &QShortcut::activated, words_,
            [this] { words_->setFocus(); });
    connect(pages_, &QTextBrowser::sourceChanged, this, &ManualWindow::showTitle);
    connect(pages_, &QTextBrowser::sourceChanged, this, &ManualWindow::showWord);
    resize(kFirstSize);
  }

  /// Shows a page by its name, "window.md", at its beginning.
  void open(const QString& page) {
    const QString folder = manual_folder();
    if (folder.isEmpty()) {
      pages_->setPlainText(
          tr("The pages of the manual are not installed with the program, in "
             "share/episcope/manual. Install it anew."));
    } else {
      pages_->setSource(QUrl::fromLocalFile(QDir(folder).filePath(page)),
                        QTextDocument::MarkdownResource);
    }
    showTitle();
    show();
    raise();
    activateWindow();
  }

 private:
  void search() {
    const QString words = words_->text().simplified();
    if (words.isEmpty()) return;
    QUrl hits;
    hits.setScheme(kSearch);
    hits.setPath(words, QUrl::DecodedMode);
    pages_->setSource(hits, QTextDocument::MarkdownResource);
  }

  void showTitle() {
    const QString heading = pages_->document()->firstBlock().text();
    setWindowTitle(heading.isEmpty() ? tr("Manual") : tr("%1 — Manual").arg(heading));
  }

  /// Goes to the first word of the search on a page that it found.
  void showWord(const QUrl& page) {
    const QString word = words_->text().simplified().section(' ', 0, 0);
    if (!word.isEmpty() && page.scheme() != kSearch) pages_->find(word);
  }

  QTextBrowser* pages_;
  QLineEdit* words_;
};

std::function<void()> make_manual(QWidget& window) {
  auto* manual = new ManualWindow(&window);
  return [manual] { manual->open(kContents); };
}

}  // namespace episcope

#include "manual_window.moc"
