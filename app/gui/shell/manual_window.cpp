// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/manual_window.h"

#include "widgets/controls/theme.h"

#include <QCoreApplication>
#include <QDir>
#include <QHBoxLayout>
#include <QPushButton>
#include <QStandardPaths>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextDocument>
#include <QUrl>
#include <QVBoxLayout>

namespace episcope {
namespace {

constexpr QSize kFirstSize(860, 720);
constexpr const char* kContents = "index.md";

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

ManualWindow::ManualWindow(QWidget* parent) : QDialog(parent), pages_(new QTextBrowser(this)) {
  setObjectName("manual");
  pages_->setObjectName("manual.pages");
  pages_->setAccessibleName(tr("Page of the manual"));
  pages_->setOpenExternalLinks(true);
  auto* contents = new QPushButton(tr("Contents"), this);
  contents->setObjectName("manual.contents");
  auto* back = new QPushButton(tr("Back"), this);
  back->setObjectName("manual.back");
  back->setEnabled(false);
  auto* row = new QHBoxLayout;
  for (auto* button : {contents, back}) {
    button->setAutoDefault(false);
    row->addWidget(button);
  }
  row->addStretch(1);
  auto* layout = new QVBoxLayout(this);
  layout->setSpacing(theme::kSpacing);
  layout->addLayout(row);
  layout->addWidget(pages_, 1);
  connect(contents, &QPushButton::clicked, this, [this] { open(kContents); });
  connect(back, &QPushButton::clicked, pages_, &QTextBrowser::backward);
  connect(pages_, &QTextBrowser::backwardAvailable, back, &QPushButton::setEnabled);
  connect(pages_, &QTextBrowser::sourceChanged, this, &ManualWindow::showTitle);
  resize(kFirstSize);
}

void ManualWindow::open(const QString& page) {
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

// The first heading of the page.
void ManualWindow::showTitle() {
  const QString heading = pages_->document()->firstBlock().text();
  setWindowTitle(heading.isEmpty() ? tr("Manual") : tr("%1 — Manual").arg(heading));
}

}  // namespace episcope

#include "moc_manual_window.cpp"
