// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QDialog>
#include <QString>

class QLineEdit;
class QTextBrowser;
class QUrl;

namespace episcope {

/// Folder of the manual's pages: share/episcope/manual of the installation or build that the
/// program runs from, else of the system. Empty if there is none.
[[nodiscard]] QString manual_folder();

/// Shows pages of the manual, which are Markdown, follows their links, goes back, and lists the
/// paragraphs that have all words of a search. Pages of the web open in the browser. Does not
/// block.
class ManualWindow : public QDialog {
  Q_OBJECT

 public:
  explicit ManualWindow(QWidget* parent);

  /// Shows a page by its name, "window.md", at its beginning.
  void open(const QString& page);

 private:
  void search();
  void showTitle();
  /// Goes to the first word of the search on a page that it found.
  void showWord(const QUrl& page);

  QTextBrowser* pages_;
  QLineEdit* words_;
};

}  // namespace episcope
