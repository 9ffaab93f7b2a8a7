// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/maps/stored_reading.h"

#include "engine/io/maps/parameter_json.h"
#include "engine/io/maps/result_file.h"

namespace episcope::io {

void write_reading(Hdf5Output& file, const std::string& group, const Reading& reading) {
  if (reading.reader.empty()) return;
  file.set_text(group, "reader", reading.reader);
  file.set_text(group, "reading", parameters_to_json(reading.options));
}

Reading reading_in(const Hdf5Input& file, const std::string& group) {
  const auto options = file.text(group, "reading");
  return {file.text(group, "reader").value_or(""),
          options ? parameters_from_json(*options) : ParameterSet()};
}

}  // namespace episcope::io
