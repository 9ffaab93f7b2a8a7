// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/baseline_file.h"

#include "engine/io/maps/parse_number.h"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <string_view>

namespace episcope::io {
namespace {

constexpr std::size_t kLongest = 1 << 16;

/// The number after a name, with anything but digits and letters between: "base_x = 0.05".
std::optional<double> number_after(const std::string& text, std::string_view name) {
  const std::size_t found = text.find(name);
  if (found == std::string::npos) return std::nullopt;
  const std::size_t begin = text.find_first_not_of(" \t\r\n\"':=,[(", found + name.size());
  if (begin == std::string::npos) return std::nullopt;
  const std::size_t end = text.find_first_not_of("0123456789.+-eE", begin);
  return parse_number(text.substr(begin, end == std::string::npos ? end : end - begin));
}

}  // namespace

std::optional<MapUnit> stated_unit(const std::filesystem::path& folder, FolderAccount& account) {
  const std::filesystem::path path = folder / kBaselineFile;
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  std::string text(kLongest, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  const std::optional<double> baseline = number_after(text, "base_x");
  if (!baseline || *baseline <= 0) return std::nullopt;
  account.use(path, "parameter files");
  return MapUnit{*baseline, fmt::format("px for a baseline of 1; that of neighbouring views is {} "
                                        "({})",
                                        *baseline, kBaselineFile)};
}

}  // namespace episcope::io
