// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/capture_files.h"

#include "app/gui/frame/dialogs.h"
#include "app/gui/frame/messages.h"

#include <QCoreApplication>

namespace episcope {
namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(episcope::CaptureFiles)
};

}  // namespace

std::filesystem::path path_of(const QString& path) {
  return path.toStdString();
}

bool is_new_light_field(const QString& path, Messages& messages) {
  if (!has_suffix(path, {"h5"}, messages)) return false;
  if (!std::filesystem::exists(path_of(path))) return true;
  messages.fail(
      Text::tr("%1 is there already; name a new file, so that no light field is lost").arg(path));
  return false;
}

}  // namespace episcope
