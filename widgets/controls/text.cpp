// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/text.h"

#include "engine/core/finding.h"

#include <QCoreApplication>
#include <QRegularExpression>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace episcope {
namespace {

constexpr double kLongest = 1e7;  // from here on digits before the point say nothing

}  // namespace

QString number_text(double value, int decimals) {
  const bool is_long = std::abs(value) >= kLongest;
  QString text = is_long ? QString::number(value, 'g', 4) : QString::number(value, 'f', decimals);
  if (!text.startsWith('-')) return text;
  text.remove(0, 1);
  const bool is_zero =
      std::all_of(text.begin(), text.end(), [](QChar each) { return each == '0' || each == '.'; });
  return is_zero ? text : kMinus + text;
}

QString with_minus(QString sentence) {
  static const QRegularExpression before_number(R"((?<![\w.)\]/-])-(?=\d))");
  return sentence.replace(before_number, kMinus);
}

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

namespace {

struct SchemaText {
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
  return text.empty() ? QString() : SchemaText::tr(text.c_str());
}

namespace {

struct FindingWords {
  Q_DECLARE_TR_FUNCTIONS(episcope::Finding)
};

std::optional<QString> known_words(const std::string& sentence);
QString other_words(const std::string& sentence);

// A number, a name, or a sentence or a literal of the engine, such as the reason in a sentence.
QString value_words(const std::string& value) {
  static const QRegularExpression words("^[^0-9/]* [^0-9/]*$");
  if (auto known = known_words(value)) return *std::move(known);
  const QString text = QString::fromStdString(value);
  return text.contains(words) ? other_words(value) : text;
}

QString filled(const std::string& text, const std::vector<std::string>& values) {
  const QString translated = FindingWords::tr(text.c_str());
  static const QRegularExpression place("%(\\d+)");
  QString words;
  qsizetype end = 0;
  for (auto match = place.match(translated); match.hasMatch();
       match = place.match(translated, end)) {
    words += translated.mid(end, match.capturedStart() - end);
    const std::size_t index = match.captured(1).toUInt() - 1;
    if (index < values.size()) words += value_words(values[index]);
    end = match.capturedEnd();
  }
  return words + translated.mid(end);
}

// Of a sentence among `kFindingTexts`.
std::optional<QString> known_words(const std::string& sentence) {
  const auto finding = finding_of(sentence);
  if (!finding) return std::nullopt;
  return with_minus(filled(numbered(find_finding_text(finding->code)->english), finding->values));
}

// Of a sentence that is not among them.
QString other_words(const std::string& sentence) {
  // Evidence of several kinds is joined.
  if (const std::size_t at = sentence.find("; "); at != std::string::npos) {
    if (schema_text(sentence) == QString::fromStdString(sentence)) {
      return finding_words(sentence.substr(0, at)) + "; " + finding_words(sentence.substr(at + 2));
    }
  }
  return with_minus(schema_text(sentence));
}

}  // namespace

QString finding_words(const std::string& sentence) {
  // Two findings that are joined may look like one with a long value.
  if (const std::size_t at = sentence.find("; "); at != std::string::npos) {
    const auto first = known_words(sentence.substr(0, at));
    const auto second = known_words(sentence.substr(at + 2));
    if (first && second) return *first + "; " + *second;
  }
  if (auto known = known_words(sentence)) return *std::move(known);
  return other_words(sentence);
}

QString label_name(const LabelInfo& label) {
  const bool has_name = label.name != default_label(label.id).name;
  return has_name ? QString::fromStdString(label.name) : SchemaText::tr("label %1").arg(label.id);
}

QString finding_brief(const std::string& sentence) {
  const auto finding = finding_of(sentence);
  if (!finding) return {};
  const std::string_view brief = find_finding_text(finding->code)->brief;
  return brief.empty() ? QString() : with_minus(filled(std::string(brief), finding->values));
}

QString value_text(const ParameterDescription& description, const ParameterValue& value) {
  if (const auto* flag = std::get_if<bool>(&value))
    return *flag ? SchemaText::tr("on") : SchemaText::tr("off");
  if (const auto* text = std::get_if<std::string>(&value)) {
    return description.choices.empty() ? QString::fromStdString(*text)
                                       : choice_label(description, *text);
  }
  const auto* interval = std::get_if<IntervalOrAuto>(&value);
  const auto* view = std::get_if<ViewOrAuto>(&value);
  if (interval && interval->is_found) return SchemaText::tr("found");
  if ((interval && !*interval) || (view && !*view)) return SchemaText::tr("auto");
  return with_unit(QString::fromStdString(to_text(value)), description.unit);
}

namespace {

const ParameterDescription* find_description(const std::vector<ParameterDescription>& descriptions,
                                             const std::string& key) {
  const auto found = std::ranges::find(descriptions, key, &ParameterDescription::key);
  return found == descriptions.end() ? nullptr : &*found;
}

}  // namespace

QString parameter_label(const std::vector<ParameterDescription>& descriptions,
                        const std::string& key) {
  const ParameterDescription* found = find_description(descriptions, key);
  return found ? schema_text(found->label) : QString::fromStdString(key);
}

QString labeled_value_text(const std::vector<ParameterDescription>& descriptions,
                           const std::string& key, const ParameterValue& value) {
  const ParameterDescription* found = find_description(descriptions, key);
  return QStringLiteral("%1 %2").arg(
      parameter_label(descriptions, key),
      found ? value_text(*found, value) : QString::fromStdString(to_text(value)));
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

namespace {

constexpr int kLongWord = 12;
constexpr int kLongestRun = 24;
constexpr QChar kBreak(0x200b);  // zero-width space

}  // namespace

QString breakable(const QString& text) {
  QString result;
  for (qsizetype begin = 0; begin <= text.size();) {
    qsizetype end = text.indexOf(' ', begin);
    if (end < 0) end = text.size();
    int run = 0;
    for (qsizetype i = begin; i < end; ++i) {
      result += text[i];
      ++run;
      const bool is_mark = QStringView(u"_/\\-").contains(text[i]) || run == kLongestRun;
      // A pair of surrogates is one letter.
      if (end - begin < kLongWord || !is_mark || text[i].isHighSurrogate()) continue;
      result += kBreak;
      run = 0;
    }
    if (end < text.size()) result += ' ';
    begin = end + 1;
  }
  return result;
}

}  // namespace episcope
