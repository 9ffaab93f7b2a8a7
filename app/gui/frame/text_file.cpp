// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/text_file.h"

#include "engine/core/error.h"

#include <QSaveFile>
#include <QString>

namespace episcope {

void write_text_file(const QString& path, const QString& text) {
  QSaveFile file(path);
  const bool is_written =
      file.open(QIODevice::WriteOnly) && file.write(text.toUtf8()) >= 0 && file.commit();
  if (!is_written) {
    throw IoError(path.toStdString(), "the file could not be written (" +
                                          file.errorString().toStdString() +
                                          "); choose another folder");
  }
}

}  // namespace episcope
