// SPDX-License-Identifier: BSD-3-Clause
// same_results A.h5 B.h5 ROWS COLUMNS: ends with 0 if two result files of a light field of so many
// views hold the same maps, bit by bit, and say the same of where they come from, but for the
// seconds; else with 1 and what differs.
#include "engine/io/models/result_file.h"

#include <cstdlib>
#include <cstring>
#include <iostream>

namespace {

using namespace episcope;

template <class T>
bool same(const ViewStack<T>& a, const ViewStack<T>& b) {
  return a.grid() == b.grid() && a.first() == b.first() && a.height() == b.height() &&
         a.width() == b.width() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same(const DisparityField& a, const DisparityField& b) {
  return same(a.disparity, b.disparity) && same(a.valid, b.valid);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const GridShape grid{std::atoi(argv[3]), std::atoi(argv[4])};
  const Estimate a = io::read_result(argv[1], grid), b = io::read_result(argv[2], grid);
  const std::pair<const char*, bool> parts[] = {
      {"disparity", same(a.field.disparity, b.field.disparity)},
      {"valid", same(a.field.valid, b.field.valid)},
      {"confidence", same(a.confidence, b.confidence)},
      {"foreground", same(a.layered.foreground, b.layered.foreground)},
      {"background", same(a.layered.background, b.layered.background)},
      {"layers", same(a.layered.layers, b.layered.layers)},
      {"second", same(a.second, b.second)},
      {"method", a.method == b.method},
      {"parameters", a.parameters == b.parameters},
      {"range", a.range == b.range},
      {"source", a.source == b.source},
      {"source_hash", a.source_hash == b.source_hash && a.source_hash != 0},
      {"reading", a.reading == b.reading},
      {"notes", a.notes == b.notes}};
  bool all = true;
  for (const auto& [name, is_same] : parts) {
    if (!is_same) std::cout << name << " differs\n";
    all = all && is_same;
  }
  return all ? 0 : 1;
}
