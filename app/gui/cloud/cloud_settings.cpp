// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/cloud/cloud_settings.h"

#include <QSettings>

#include <algorithm>

namespace episcope {
namespace {

// A number of an enumeration, at most `last`; 0 for what another version may have written.
template <class Value>
Value read_value(const QSettings& settings, const char* key, Value last) {
  const int number = settings.value(key).toInt();
  return number >= 0 && number <= static_cast<int>(last) ? static_cast<Value>(number) : Value{};
}

double read_number(const QSettings& settings, const char* key, double plain, double least,
                   double most) {
  return std::clamp(settings.value(key, plain).toDouble(), least, most);
}

}  // namespace

CloudSettings read_cloud_settings() {
  const QSettings settings;
  const CloudSettings plain;
  CloudSettings read;
  read.choice.coloring = read_value(settings, "cloud/coloring", CloudColoring::Source);
  read.choice.companion = read_value(settings, "cloud/companion", CloudCompanion::Other);
  read.choice.is_beside = settings.value("cloud/beside").toBool();
  read.choice.is_surface = settings.value("cloud/surface").toBool();
  read.choice.jump_px = read_number(settings, "cloud/jump", plain.choice.jump_px, 0.01, 5);
  read.look.point_size = read_number(settings, "cloud/size", plain.look.point_size, 1, 10);
  read.look.is_shaded = settings.value("cloud/shaded").toBool();
  read.is_large = settings.value("cloud/large").toBool();
  return read;
}

void write_cloud_settings(const CloudSettings& written) {
  QSettings settings;
  settings.setValue("cloud/coloring", static_cast<int>(written.choice.coloring));
  settings.setValue("cloud/companion", static_cast<int>(written.choice.companion));
  settings.setValue("cloud/beside", written.choice.is_beside);
  settings.setValue("cloud/surface", written.choice.is_surface);
  settings.setValue("cloud/jump", written.choice.jump_px);
  settings.setValue("cloud/size", written.look.point_size);
  settings.setValue("cloud/shaded", written.look.is_shaded);
  settings.setValue("cloud/large", written.is_large);
}

}  // namespace episcope
