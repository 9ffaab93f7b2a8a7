// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/style/schema_text.h"

#include <QCoreApplication>

#include <algorithm>

namespace episcope {
namespace {

struct Text {
  Q_DECLARE_TR_FUNCTIONS(episcope::Schema)
};

QString with_unit(const QString& number, const std::string& unit) {
  return unit.empty() ? number : number + ' ' + schema_text(unit);
}

QString choice_label(const ParameterDescription& description, const std::string& choice) {
  const auto& choices = description.choices;
  const auto place = std::ranges::find(choices, choice) - choices.begin();
  const auto& labels = description.choice_labels;
  const bool has_label = place < static_cast<std::ptrdiff_t>(labels.size());
  return schema_text(has_label ? labels[static_cast<std::size_t>(place)] : choice);
}

}  // namespace

QString schema_text(const std::string& text) {
  return text.empty() ? QString() : Text::tr(text.c_str());
}

QString value_text(const ParameterDescription& description, const ParameterValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? Text::tr("on") : Text::tr("off");
  if (const auto* text = std::get_if<std::string>(&value)) {
    return description.choices.empty() ? QString::fromStdString(*text)
                                       : choice_label(description, *text);
  }
  const auto* interval = std::get_if<IntervalOrAuto>(&value);
  const auto* view = std::get_if<ViewOrAuto>(&value);
  if (interval && interval->is_found) return Text::tr("found");
  if ((interval && !*interval) || (view && !*view)) return Text::tr("auto");
  return with_unit(QString::fromStdString(to_text(value)), description.unit);
}

QString domain_text(const ParameterDescription& description) {
  const ParameterValue& value = description.default_value;
  const bool has_domain = std::holds_alternative<int>(value) ||
                          std::holds_alternative<double>(value) ||
                          std::holds_alternative<IntervalOrAuto>(value);
  if (!has_domain) return {};
  const QString ends =
      QStringLiteral("%1 … %2").arg(QString::fromStdString(to_text(description.min)),
                                    QString::fromStdString(to_text(description.max)));
  return with_unit(ends, description.unit);
}

}  // namespace episcope
