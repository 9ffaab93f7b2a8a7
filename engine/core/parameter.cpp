// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/parameter.h"

#include "engine/core/error.h"
#include "engine/core/text.h"

#include <charconv>
#include <numeric>
#include <string_view>

namespace episcope {
namespace {

template <class Number>
std::string number_text(Number number) {
  char buffer[64];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, number);
  return {buffer, result.ptr};
}

template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  Number number{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string domain_text(const ParameterDescription& description) {
  if (!description.choices.empty()) {
    std::string text;
    for (const auto& choice : description.choices) text += (text.empty() ? "" : ", ") + choice;
    return "one of " + text;
  }
  return "a number from " + number_text(description.min) + " to " + number_text(description.max);
}

[[noreturn]] void refuse(const ParameterDescription& description, const std::string& value,
                         const std::string& expected) {
  throw InvalidInput("parameter " + description.key + " is " + value + ", but must be " + expected);
}

struct Checker {
  const ParameterDescription& description;

  void in_domain(double number) const {
    if (!(number >= description.min && number <= description.max)) {
      refuse(description, number_text(number), domain_text(description));
    }
  }
  void operator()(bool) const {}
  void operator()(int number) const { in_domain(number); }
  void operator()(double number) const { in_domain(number); }
  void operator()(const std::string& text) const {
    const auto& choices = description.choices;
    if (choices.empty() || std::find(choices.begin(), choices.end(), text) != choices.end()) return;
    refuse(description, "'" + text + "'", domain_text(description));
  }
  void operator()(const IntervalOrAuto& interval) const {
    if (!interval) return;
    in_domain(interval->min);
    in_domain(interval->max);
    if (!(interval->min < interval->max)) {
      refuse(description, to_text(interval), "auto, found or A,B with A < B");
    }
  }
  void operator()(const ViewOrAuto& view) const {
    if (view && (view->v < 0 || view->u < 0)) {
      refuse(description, view_text(*view), "auto or V,U, counted from 0");
    }
  }
};

struct Parser {
  const ParameterDescription& description;
  const std::string& text;

  ParameterValue operator()(bool) const {
    if (text == "true" || text == "1" || text == "on" || text == "yes") return true;
    if (text == "false" || text == "0" || text == "off" || text == "no") return false;
    refuse(description, "'" + text + "'", "true or false");
  }
  ParameterValue operator()(int) const {
    if (const auto number = parse_number<int>(text)) return *number;
    refuse(description, "'" + text + "'", "a whole number, " + domain_text(description));
  }
  ParameterValue operator()(double) const {
    if (const auto number = parse_number<double>(text)) return *number;
    refuse(description, "'" + text + "'", domain_text(description));
  }
  ParameterValue operator()(const std::string&) const { return text; }
  ParameterValue operator()(const IntervalOrAuto&) const {
    if (text == "auto") return IntervalOrAuto{};
    if (text == "found") return IntervalOrAuto::found();
    const auto comma = text.find(',');
    if (comma != std::string::npos) {
      const auto min = parse_number<double>(std::string_view(text).substr(0, comma));
      const auto max = parse_number<double>(std::string_view(text).substr(comma + 1));
      if (min && max) return IntervalOrAuto(Interval{*min, *max});
    }
    refuse(description, "'" + text + "'", "auto, found or two numbers A,B");
  }
  ParameterValue operator()(const ViewOrAuto&) const {
    if (text == "auto") return ViewOrAuto{};
    if (const auto comma = text.find(','); comma != std::string::npos) {
      const auto v = parse_number<int>(std::string_view(text).substr(0, comma));
      const auto u = parse_number<int>(std::string_view(text).substr(comma + 1));
      if (v && u) return ViewOrAuto(ViewIndex{*v, *u});
    }
    refuse(description, "'" + text + "'", "auto or V,U, row and column of a view");
  }
};

// The value of a parameter with presets: as given, else its default.
const ParameterValue& chosen(const ParameterDescription& description, const ParameterSet& values) {
  const auto given = std::find_if(values.begin(), values.end(), [&](const auto& value) {
    return value.first == description.key;
  });
  return given == values.end() ? description.default_value : given->second;
}

// Empty if the choice means nothing for others.
const Preset* chosen_preset(const ParameterDescription& description, const ParameterSet& values) {
  if (description.presets.empty()) return nullptr;
  const auto found = std::find_if(
      description.presets.begin(), description.presets.end(), [&](const Preset& preset) {
        return chosen(description, values) == ParameterValue(preset.choice);
      });
  return found == description.presets.end() ? nullptr : &*found;
}

void apply(const Preset& preset, std::vector<ParameterDescription>& descriptions) {
  for (ParameterDescription& other : descriptions) {
    for (const auto& [key, value] : preset.values) {
      if (key != other.key) continue;
      other.default_value = value;
      other.searched.clear();
    }
    for (const auto& [key, searched] : preset.searched) {
      if (key == other.key) other.searched = searched;
    }
  }
}

}  // namespace

bool has_numeric_domain(const ParameterDescription& description) {
  return !std::holds_alternative<bool>(description.default_value) &&
         !std::holds_alternative<std::string>(description.default_value) &&
         !std::holds_alternative<ViewOrAuto>(description.default_value);
}

std::vector<ParameterDescription> described_under(std::vector<ParameterDescription> descriptions,
                                                  const ParameterSet& values) {
  std::vector<Preset> presets;
  for (const ParameterDescription& description : descriptions) {
    if (const Preset* preset = chosen_preset(description, values)) presets.push_back(*preset);
  }
  for (const Preset& preset : presets) apply(preset, descriptions);
  return descriptions;
}

ParameterSet preset_values(const std::vector<ParameterDescription>& descriptions,
                           const ParameterSet& values) {
  ParameterSet all;
  for (const ParameterDescription& description : descriptions) {
    const Preset* preset = chosen_preset(description, values);
    if (preset) all.insert(all.end(), preset->values.begin(), preset->values.end());
  }
  return all;
}

std::string presets_text(const ParameterDescription& description) {
  const auto value_text = [](const auto& value) {
    return value.first + " " + to_text(value.second);
  };
  return joined(description.presets, "; ", [&](const Preset& preset) {
    std::string text = preset.choice;
    return text.append(" sets ").append(joined(preset.values, ", ", value_text));
  });
}

std::string to_text(const ParameterValue& value) {
  struct Writer {
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(int number) const { return number_text(number); }
    std::string operator()(double number) const { return number_text(number); }
    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(const IntervalOrAuto& interval) const {
      return interval ? number_text(interval->min) + "," + number_text(interval->max)
                      : interval.word();
    }
    std::string operator()(const ViewOrAuto& view) const {
      return view ? view_text(*view) : "auto";
    }
  };
  return std::visit(Writer{}, value);
}

ParameterValue parse_parameter(const ParameterDescription& description, const std::string& text) {
  auto value = std::visit(Parser{description, text}, description.default_value);
  check_parameter(description, value);
  return value;
}

void check_parameter(const ParameterDescription& description, const ParameterValue& value) {
  if (value.index() != description.default_value.index()) {
    refuse(description, to_text(value),
           "of the type of its default " + to_text(description.default_value));
  }
  std::visit(Checker{description}, value);
}

const ParameterValue* find_value(const ParameterSet& set, const std::string& key) {
  const auto found = std::ranges::find(set, key, &ParameterSet::value_type::first);
  return found == set.end() ? nullptr : &found->second;
}

void set_value(ParameterSet& set, const std::string& key, ParameterValue value) {
  const auto found = std::ranges::find(set, key, &ParameterSet::value_type::first);
  if (found == set.end()) {
    set.emplace_back(key, std::move(value));
  } else {
    found->second = std::move(value);
  }
}

std::string nearest_name(const std::string& name, const std::vector<std::string>& names) {
  const auto distance = [&name](const std::string& other) {
    std::vector<std::size_t> row(other.size() + 1);
    std::iota(row.begin(), row.end(), 0);
    for (std::size_t i = 0; i < name.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i + 1;
      for (std::size_t j = 0; j < other.size(); ++j) {
        const std::size_t substitution = diagonal + (name[i] == other[j] ? 0 : 1);
        diagonal = row[j + 1];
        row[j + 1] = std::min({substitution, row[j] + 1, row[j + 1] + 1});
      }
    }
    return row.back();
  };
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, name.size() / 2) + 1;
  for (const auto& other : names) {
    if (const auto edits = distance(other); edits < least) {
      least = edits;
      nearest = other;
    }
  }
  return nearest;
}

std::string no_such_name(const std::string& kind, const std::string& name,
                         const std::vector<std::string>& names) {
  const std::string nearest = nearest_name(name, names);
  return "there is no " + kind + " '" + name + "'" +
         (nearest.empty() ? "" : "; did you mean '" + nearest + "'?");
}

}  // namespace episcope
