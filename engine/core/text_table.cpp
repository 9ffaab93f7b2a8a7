// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/text_table.h"

#include "engine/core/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope {
namespace {

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string latex_cell(const std::string& text) {
  static const std::string times = "×", minus = "−";
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (text.compare(i, times.size(), times) == 0) {
      escaped += "$\\times$";
      i += times.size() - 1;
    } else if (text.compare(i, minus.size(), minus) == 0) {
      escaped += "$-$";
      i += minus.size() - 1;
    } else if (c == '\\') {
      escaped += "\\textbackslash{}";
    } else if (c == '<' || c == '>' || c == '|') {  // other glyphs in the usual font
      escaped += c == '<' ? "\\textless{}" : c == '>' ? "\\textgreater{}" : "\\textbar{}";
    } else if (c == '~' || c == '^') {
      escaped += std::string("\\") + c + "{}";
    } else {
      if (std::string("_%&#${}").find(c) != std::string::npos) escaped += '\\';
      escaped += c;
    }
  }
  return escaped;
}

}  // namespace

std::size_t character_count(const std::string& text) {
  return text.size() - static_cast<std::size_t>(std::ranges::count_if(text, continues_character));
}

std::string fixed_text(double value, int digits) {
  return fmt::format("{:.{}f}", value, digits);
}

TextTable transposed(const TextTable& table) {
  TextTable result;
  for (std::size_t column = 0; column < table.header.size(); ++column) {
    std::vector<std::string> cells{table.header[column]};
    for (const auto& row : table.rows) cells.push_back(row[column]);
    if (column == 0) {
      result.header = std::move(cells);
    } else {
      result.rows.push_back(std::move(cells));
    }
  }
  return result;
}

std::string table_to_text(const TextTable& table) {
  std::vector<std::size_t> widths(table.header.size());
  const auto widen = [&widths](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      widths[i] = std::max(widths[i], character_count(cells[i]));
    }
  };
  widen(table.header);
  for (const auto& row : table.rows) widen(row);
  std::string text;
  const auto write = [&](const std::vector<std::string>& cells) {
    std::string line;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string space(widths[i] - character_count(cells[i]), ' ');
      line += (i > 0 ? "  " : "") + (i == 0 ? cells[i] + space : space + cells[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  };
  write(table.header);
  for (const auto& row : table.rows) write(row);
  return text;
}

std::string table_to_narrow_text(const TextTable& table) {
  const auto width = [](const std::string& text) {
    std::size_t widest = 0;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = text.find('\n', begin);
      widest = std::max(widest, character_count(text.substr(begin, end - begin)));
      begin = end + 1;
    }
    return widest;
  };
  const std::string upright = table_to_text(table);
  const std::string lying = table_to_text(transposed(table));
  return width(lying) <= width(upright) ? lying : upright;
}

std::string table_to_csv(const TextTable& table) {
  std::string text = joined(table.header, ",", csv_cell) + "\n";
  for (const auto& row : table.rows) text += joined(row, ",", csv_cell) + "\n";
  return text;
}

std::string table_to_latex(const TextTable& table) {
  std::string columns(table.header.size(), 'r');
  columns.front() = 'l';
  std::string text = "\\begin{tabular}{" + columns + "}\n\\toprule\n" +
                     joined(table.header, " & ", latex_cell) + " \\\\\n\\midrule\n";
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    std::size_t column = 0;
    const auto cell = [&](const std::string& each) {
      const std::size_t place = column++;
      const bool is_stressed = row < table.stressed.size() && table.stressed[row][place];
      return is_stressed ? "\\textbf{" + latex_cell(each) + "}" : latex_cell(each);
    };
    text += joined(table.rows[row], " & ", cell) + " \\\\\n";
  }
  return text + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace episcope
