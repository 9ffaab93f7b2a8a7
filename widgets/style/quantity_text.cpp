// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/style/quantity_text.h"

#include <QCoreApplication>

namespace episcope {
namespace {

QString translated(const char* text) {
  return *text == '\0' ? QString() : QCoreApplication::translate("episcope::render", text);
}

}  // namespace

QString quantity_label(render::Quantity quantity) {
  return translated(render::info_of(quantity).label);
}

QString quantity_button(render::Quantity quantity) {
  return translated(render::info_of(quantity).button);
}

QString quantity_tip(render::Quantity quantity) {
  return translated(render::info_of(quantity).tip);
}

QString quantity_unit(render::Quantity quantity) {
  return translated(render::info_of(quantity).unit);
}

}  // namespace episcope
