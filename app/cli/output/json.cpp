// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/output/json.h"

#include <iostream>

namespace episcope::cli {

Json value_json(const ParameterValue& value) {
  struct Writer {
    Json operator()(const IntervalOrAuto& interval) const {
      return interval ? interval_json(*interval) : Json("auto");
    }
    Json operator()(const ViewOrAuto& view) const {
      return view ? Json{view->v, view->u} : Json("auto");
    }
    Json operator()(const std::string& text) const { return text; }
    Json operator()(bool flag) const { return flag; }
    Json operator()(int number) const { return number; }
    Json operator()(double number) const { return number; }
  };
  return std::visit(Writer{}, value);
}

Json interval_json(const Interval& interval) {
  return {interval.min, interval.max};
}

void print_json(const Json& json) {
  // Names of files may be any bytes: those that are not UTF-8 become the replacement character.
  std::cout << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

}  // namespace episcope::cli
