// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/opening/remembered_conventions.h"

#include "engine/core/error.h"
#include "engine/io/open/open_options.h"

#include <QSettings>
#include <QUrl>
#include <QVariantMap>

namespace episcope {
namespace {

// Slashes would make groups of the path's folders.
QString key_of(const QString& path) {
  return "conventions/" + QString::fromLatin1(QUrl::toPercentEncoding(path));
}

}  // namespace

ParameterSet remembered_conventions(const QString& path) {
  const QVariantMap texts = QSettings().value(key_of(path)).toMap();
  ParameterSet given;
  for (const ParameterDescription& option : io::open_schema().descriptions()) {
    const QVariant text = texts.value(QString::fromStdString(option.key));
    if (!text.isValid()) continue;
    try {
      given.emplace_back(option.key, parse_parameter(option, text.toString().toStdString()));
    } catch (const InvalidInput&) {
      // Settings are a file that anybody may edit: what is no choice counts as automatic.
    }
  }
  return given;
}

void remember_conventions(const QString& path, const ParameterSet& given) {
  if (given.empty()) {
    QSettings().remove(key_of(path));
    return;
  }
  QVariantMap texts;
  for (const auto& [key, value] : given) {
    texts[QString::fromStdString(key)] = QString::fromStdString(to_text(value));
  }
  QSettings().setValue(key_of(path), texts);
}

}  // namespace episcope
