// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/maps/result_provenance.h"

#include "engine/core/hash/fnv1a.h"
#include "engine/core/version.h"
#include "engine/io/maps/parameter_json.h"
#include "engine/io/maps/result_file.h"
#include "engine/io/maps/stored_reading.h"

namespace episcope::io {
namespace {

std::string join_lines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

}  // namespace

std::string in_group(const char* name) {
  return std::string(kResultGroup) + "/" + name;
}

void write_provenance(Hdf5Output& file, const Provenance& estimate, const MapGeometry& maps,
                      const std::string& source) {
  file.set_text(kResultGroup, "method", estimate.method);
  file.set_text(kResultGroup, "parameters", parameters_to_json(estimate.parameters));
  file.set_number(kResultGroup, "seconds", estimate.seconds);
  file.set_text(kResultGroup, "version", estimate.version.empty() ? kVersion : estimate.version);
  file.set_text(kResultGroup, "source", source);
  if (estimate.source_hash != 0) {
    file.set_text(kResultGroup, "source_hash", hash_digits(estimate.source_hash));
  }
  write_reading(file, kResultGroup, estimate.reading);
  if (!(estimate.range == Interval{})) {
    file.set_numbers(kResultGroup, "range", {estimate.range.min, estimate.range.max});
  }
  if (maps.grid.count() == 1) {
    file.set_integers(kResultGroup, "view", {maps.first.v, maps.first.u});
  } else if (!(maps.first == ViewIndex{})) {
    file.set_integers(kResultGroup, "first_view", {maps.first.v, maps.first.u});
  }
  if (!estimate.notes.empty()) file.set_text(kResultGroup, "notes", join_lines(estimate.notes));
  if (estimate.border_px > 0) file.set_number(kResultGroup, "border_px", estimate.border_px);
}

}  // namespace episcope::io
