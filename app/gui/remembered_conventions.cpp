// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/remembered_conventions.h"

#include <QSettings>
#include <QUrl>
#include <QVariantMap>

namespace episcope {
namespace {

using Flip = io::OpenOptions::Flip;
using Units = io::OpenOptions::Units;

// Slashes would make groups of the path's folders.
QString key_of(const QString& path) {
  return "conventions/" + QString::fromLatin1(QUrl::toPercentEncoding(path));
}

// Settings are a file that anybody may edit: what is no choice counts as automatic.
template <class Choice>
Choice choice_of(const QVariant& value, Choice last) {
  const int number = value.toInt();
  return number >= 0 && number <= static_cast<int>(last) ? static_cast<Choice>(number)
                                                         : Choice::Auto;
}

}  // namespace

bool overrules(const io::OpenOptions& conventions) {
  return conventions.flip != Flip::Auto || conventions.units != Units::Auto ||
         !conventions.pattern.empty() || conventions.snake;
}

io::OpenOptions remembered_conventions(const QString& path) {
  const QVariantMap values = QSettings().value(key_of(path)).toMap();
  io::OpenOptions conventions;
  conventions.flip = choice_of(values["flip"], Flip::Both);
  conventions.units = choice_of(values["units"], Units::WithoutWidth);
  conventions.pattern = values["pattern"].toString().toStdString();
  conventions.snake = values["snake"].toBool();
  return conventions;
}

void remember_conventions(const QString& path, const io::OpenOptions& conventions) {
  if (!overrules(conventions)) {
    QSettings().remove(key_of(path));
    return;
  }
  QSettings().setValue(key_of(path),
                       QVariantMap{{"flip", static_cast<int>(conventions.flip)},
                                   {"units", static_cast<int>(conventions.units)},
                                   {"pattern", QString::fromStdString(conventions.pattern)},
                                   {"snake", conventions.snake}});
}

}  // namespace episcope
