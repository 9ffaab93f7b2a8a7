// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

#include <functional>

class QWidget;

namespace episcope {

/// What to do with a file that another program wrote since it was read.
struct ChangedFileAnswers {
  std::function<void()> overwrite;
  std::function<void()> elsewhere;  ///< Save to another file.
  std::function<void()> reload;     ///< Take what is in the file; not offered if empty.
  QString of_reloading;             ///< A sentence: what reloading does to what is open.
};

/// Asks; one of the answers is called, or none. Blocks nothing.
void ask_about_changed_file(QWidget* window, const QString& path,
                            const ChangedFileAnswers& answers);

}  // namespace episcope
