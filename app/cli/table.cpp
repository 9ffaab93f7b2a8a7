// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/table.h"

#include <algorithm>

namespace episcope::cli {
namespace {

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string latex_cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\') {
      escaped += "\\textbackslash{}";
    } else if (c == '~' || c == '^') {
      escaped += std::string("\\") + c + "{}";
    } else {
      if (std::string("_%&#${}").find(c) != std::string::npos) escaped += '\\';
      escaped += c;
    }
  }
  return escaped;
}

template <class Cell>
std::string joined(const std::vector<std::string>& cells, const char* separator, Cell cell) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i > 0 ? separator : "") + cell(cells[i]);
  return line;
}

}  // namespace

std::size_t letters_in(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::string table_to_text(const Table& table) {
  std::vector<std::size_t> widths(table.header.size());
  const auto widen = [&widths](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      widths[i] = std::max(widths[i], letters_in(cells[i]));
    }
  };
  widen(table.header);
  for (const auto& row : table.rows) widen(row);
  std::string text;
  const auto write = [&](const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string space(widths[i] - letters_in(cells[i]), ' ');
      line += (i > 0 ? "  " : "") + (i == 0 ? cells[i] + space : space + cells[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  };
  write(table.header);
  for (const auto& row : table.rows) write(row);
  return text;
}

std::string table_to_csv(const Table& table) {
  std::string text = joined(table.header, ",", csv_cell) + "\n";
  for (const auto& row : table.rows) text += joined(row, ",", csv_cell) + "\n";
  return text;
}

std::string table_to_latex(const Table& table) {
  std::string columns(table.header.size(), 'r');
  columns.front() = 'l';
  std::string text = "\\begin{tabular}{" + columns + "}\n\\toprule\n" +
                     joined(table.header, " & ", latex_cell) + " \\\\\n\\midrule\n";
  for (const auto& row : table.rows) text += joined(row, " & ", latex_cell) + " \\\\\n";
  return text + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace episcope::cli
