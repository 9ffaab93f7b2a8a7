// SPDX-License-Identifier: BSD-3-Clause
//
// flat_scene SCENE SIZE OUT METHOD THREADS: writes a built-in scene with the centre's truth and a
// method's map (none: without) as scenes.py reads it: int32 rows, columns, height, width; uint8 RGB views; float
// truth; float map, NaN where invalid. The method searches the range of the truth ± 0.1 px.
// Linked against the engine's libraries; README.md has the command.
#include "engine/disparity/registry.h"
#include "engine/scenes/builtin.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

using namespace episcope;

namespace {

template <class T>
void put(std::ofstream& file, const std::vector<T>& values) {
  file.write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(T)));
}

void put_views(std::ofstream& file, const LightField& lf) {
  const int channels = lf.channels();
  std::vector<float> row(static_cast<std::size_t>(lf.width()) * channels);
  std::vector<std::uint8_t> out(static_cast<std::size_t>(lf.width()) * 3);
  for (int i = 0; i < lf.grid().count(); ++i) {
    for (int y = 0; y < lf.height(); ++y) {
      lf.read_row(lf.grid().view_at(i), y, 0, lf.width(), row.data());
      for (std::size_t k = 0; k < out.size(); ++k) {
        out[k] = static_cast<std::uint8_t>(std::lround(row[channels == 3 ? k : k / 3] * 255));
      }
      put(file, out);
    }
  }
}

Interval put_map(std::ofstream& file, const DisparityView& map) {
  Interval range{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (int y = 0; y < map.disparity.height; ++y) {
    std::vector<float> row;
    for (int x = 0; x < map.disparity.width; ++x) {
      row.push_back(map.is_valid(y, x) ? map.disparity.at(y, x) : NAN);
      if (std::isnan(row.back())) continue;
      range = {std::min<double>(range.min, row.back()), std::max<double>(range.max, row.back())};
    }
    put(file, row);
  }
  return range;
}

}  // namespace

int main(int count, char** arguments) try {
  if (count != 6) return 2;
  const std::string text = arguments[1];
  scenes::BuiltinRequest request = scenes::read_request(text.substr(text.find(':') + 1));
  scenes::RenderOptions& options = request.options;
  if (options.width == scenes::RenderOptions().width) {
    options.width = options.height = std::atoi(arguments[2]);
  }
  const Progress progress(std::atoi(arguments[5]));
  const Scene scene = scenes::render_builtin(request.scene, options, progress);
  const LightField& lf = *scene.light_field;
  std::ofstream file(arguments[3], std::ios::binary);
  put(file, std::vector<std::int32_t>{lf.grid().v, lf.grid().u, lf.height(), lf.width()});
  put_views(file, lf);
  const Interval range = put_map(file, scene.truth->field.view(lf.center()));
  if (std::string(arguments[4]) == "none") return file ? 0 : 1;
  const ParameterSet values = {{"range", IntervalOrAuto{Interval{range.min - .1, range.max + .1}}}};
  const Estimate estimate =
      find_estimator(arguments[4]).run(lf, values, {.views = ViewSelection::Center}, progress);
  put_map(file, estimate.field.view(lf.center()));
  return file ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
