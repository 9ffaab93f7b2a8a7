// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/schema.h"

#include <algorithm>

namespace episcope {
namespace {

const void* at(const void* parameters, std::size_t place) {
  return static_cast<const std::byte*>(parameters) + place;
}

}  // namespace

void AnySchema::add(const char* key, Text text, Domain domain, Field field, const void* defaults) {
  descriptions_.push_back({.key = key,
                           .label = text.label,
                           .help = text.help,
                           .unit = text.unit,
                           .default_value = field.read(at(defaults, field.place)),
                           .min = domain.min,
                           .max = domain.max,
                           .logarithmic = domain.logarithmic});
  fields_.push_back(field);
}

void AnySchema::add_part(const AnySchema& part, std::size_t place, const void* defaults) {
  for (std::size_t i = 0; i < part.fields_.size(); ++i) {
    Field field = part.fields_[i];
    ParameterDescription description = part.descriptions_[i];
    description.default_value = field.read(at(defaults, field.place));
    description.searched.clear();
    for (Preset& preset : description.presets) preset.searched.clear();
    descriptions_.push_back(std::move(description));
    field.place += place;
    fields_.push_back(field);
  }
}

void AnySchema::add_choice_names(const char* name, const char* label) {
  descriptions_.back().choices.emplace_back(name);
  descriptions_.back().choice_labels.emplace_back(label);
}

void AnySchema::move_first(const char* key) {
  const auto index = static_cast<std::ptrdiff_t>(index_of(key));
  const auto rotate = [index](auto& list) {
    std::rotate(list.begin(), list.begin() + index, list.begin() + index + 1);
  };
  rotate(descriptions_);
  rotate(fields_);
}

void AnySchema::set_preset(const char* key, const char* choice, const ParameterSet& values) {
  Preset& changed = preset_of(key, choice);
  for (const auto& given : values) {
    check_parameter(description(given.first), given.second);
    std::erase_if(changed.values, [&](const auto& known) { return known.first == given.first; });
    changed.values.push_back(given);
  }
}

void AnySchema::set_preset_search(const char* key, const char* choice, const char* searched,
                                  std::initializer_list<double> values) {
  preset_of(key, choice).searched.emplace_back(searched, like_default(searched, values));
}

void AnySchema::set_search(const char* key, std::initializer_list<double> values) {
  descriptions_[index_of(key)].searched = like_default(key, values);
}

void AnySchema::write(const ParameterSet& values, void* parameters) const {
  for (const ParameterSet& set : {preset_values(descriptions_, values), values}) {
    for (const auto& [key, value] : set) {
      const std::size_t index = index_of(key);
      check_parameter(descriptions_[index], value);
      const Field& field = fields_[index];
      field.write(static_cast<std::byte*>(parameters) + field.place, value);
    }
  }
}

ParameterSet AnySchema::read(const void* parameters) const {
  ParameterSet set;
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    set.emplace_back(descriptions_[i].key, fields_[i].read(at(parameters, fields_[i].place)));
  }
  return set;
}

ParameterSet AnySchema::read_changed(const void* parameters) const {
  ParameterSet set = read(parameters);
  std::erase_if(set, [this](const auto& each) {
    return each.second == description(each.first).default_value;
  });
  return set;
}

std::size_t AnySchema::index_of(const std::string& key) const {
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < descriptions_.size(); ++i) {
    if (descriptions_[i].key == key) return i;
    keys.push_back(descriptions_[i].key);
  }
  throw InvalidInput(no_such_name("parameter", key, keys));
}

std::vector<ParameterValue> AnySchema::like_default(const char* key,
                                                    std::initializer_list<double> values) const {
  const ParameterDescription& described = description(key);
  std::vector<ParameterValue> typed;
  for (const double value : values) {
    ParameterValue& last = typed.emplace_back(value);
    if (std::holds_alternative<bool>(described.default_value)) last = value != 0;
    if (std::holds_alternative<int>(described.default_value)) last = static_cast<int>(value);
    check_parameter(described, last);
  }
  return typed;
}

Preset& AnySchema::preset_of(const char* key, const char* choice) {
  ParameterDescription& described = descriptions_[index_of(key)];
  check_parameter(described, std::string(choice));
  for (Preset& preset : described.presets) {
    if (preset.choice == choice) return preset;
  }
  return described.presets.emplace_back(Preset{choice, {}});
}

}  // namespace episcope
