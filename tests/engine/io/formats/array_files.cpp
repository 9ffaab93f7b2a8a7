// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/io/formats/array_files.h"

#include <matio.h>
#include <zlib.h>

#include <algorithm>
#include <fstream>

namespace episcope::test {
namespace {

std::size_t length_of(const ViewStack<std::uint8_t>& views, char letter) {
  switch (letter) {
    case 'v':
      return static_cast<std::size_t>(views.grid().v);
    case 'u':
      return static_cast<std::size_t>(views.grid().u);
    case 'n':
      return static_cast<std::size_t>(views.grid().count());
    case 'y':
      return static_cast<std::size_t>(views.height());
    case 'x':
      return static_cast<std::size_t>(views.width());
    default:
      return static_cast<std::size_t>(views.channels());
  }
}

std::string little_endian(std::uint64_t number, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i, number >>= 8) text += static_cast<char>(number);
  return text;
}

std::string deflated(const std::string& bytes) {
  z_stream state{};
  deflateInit2(&state, 6, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&state, bytes.size()), '\0');
  state.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  state.avail_in = static_cast<uInt>(bytes.size());
  state.next_out = reinterpret_cast<Bytef*>(out.data());
  state.avail_out = static_cast<uInt>(out.size());
  deflate(&state, Z_FINISH);
  out.resize(state.total_out);
  deflateEnd(&state);
  return out;
}

/// A 2-D array of doubles.
matvar_t* map_variable(const std::string& name, ImageView<const float> map) {
  std::vector<double> numbers;
  for (int x = 0; x < map.width; ++x) {
    for (int y = 0; y < map.height; ++y) numbers.push_back(map.at(y, x));
  }
  std::size_t dims[] = {static_cast<std::size_t>(map.height), static_cast<std::size_t>(map.width)};
  return Mat_VarCreate(name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, numbers.data(), 0);
}

void write_variable(mat_t* file, matvar_t* variable, matio_compression compression) {
  Mat_VarWrite(file, variable, compression);
  Mat_VarFree(variable);
}

}  // namespace

std::vector<std::size_t> lengths_of(const ViewStack<std::uint8_t>& views, const std::string& axes) {
  std::vector<std::size_t> lengths;
  for (const char letter : axes) lengths.push_back(length_of(views, letter));
  return lengths;
}

std::vector<std::uint8_t> in_axes(const ViewStack<std::uint8_t>& views, const std::string& axes) {
  const std::vector<std::size_t> lengths = lengths_of(views, axes);
  std::vector<std::uint8_t> samples;
  std::vector<std::size_t> at(axes.size(), 0);
  for (;;) {
    const auto place = [&](char letter) {
      const std::size_t axis = axes.find(letter);
      return axis == std::string::npos ? 0 : static_cast<int>(at[axis]);
    };
    const int n = place('n');
    const int u = views.grid().u;
    const ViewIndex view{place('v') + n / u, place('u') + n % u};
    samples.push_back(views.view(view).at(place('y'), place('x'), place('c')));
    std::size_t axis = axes.size();
    while (axis > 0 && ++at[axis - 1] == lengths[axis - 1]) at[--axis] = 0;
    if (axis == 0) return samples;
  }
}

void write_mat5(const std::filesystem::path& path, const ViewStack<std::uint8_t>& views,
                const Mat5Form& form) {
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5);
  const auto compression = form.is_compressed ? MAT_COMPRESSION_ZLIB : MAT_COMPRESSION_NONE;
  // Column-major: the contiguous axis is the last here.
  std::vector<std::uint8_t> samples = in_axes(views, "cxyuv");
  std::vector<double> numbers(samples.begin(), samples.end());
  std::ranges::for_each(numbers, [](double& number) { number /= 255; });
  std::vector<std::size_t> dims = lengths_of(views, "vuyxc");
  matvar_t* array =
      form.is_double
          ? Mat_VarCreate("LF", MAT_C_DOUBLE, MAT_T_DOUBLE, 5, dims.data(), numbers.data(), 0)
          : Mat_VarCreate("LF", MAT_C_UINT8, MAT_T_UINT8, 5, dims.data(), samples.data(), 0);
  matvar_t* top = array;
  if (!form.structure.empty()) {
    const char* fields[] = {"LF"};
    std::size_t one[] = {1, 1};
    top = Mat_VarCreateStruct(form.structure.c_str(), 2, one, fields, 1);
    Mat_VarSetStructFieldByName(top, "LF", 0, array);
  }
  write_variable(file, top, compression);
  if (form.has_other) {
    double pair[] = {1, 2};
    std::size_t size[] = {1, 2};
    char text[] = "hello";
    std::size_t length[] = {1, 5};
    matvar_t* matrix = Mat_VarCreate("H", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, pair, 0);
    matvar_t* note = Mat_VarCreate("note", MAT_C_CHAR, MAT_T_UINT8, 2, length, text, 0);
    for (matvar_t* variable : {matrix, note}) write_variable(file, variable, compression);
  }
  if (!form.label.empty()) write_variable(file, map_variable("label", form.label), compression);
  Mat_Close(file);
}

void write_mat5_cells(const std::filesystem::path& path, const ViewStack<std::uint8_t>& views,
                      bool is_compressed, Mat5Views form) {
  std::size_t grid[] = {length_of(views, 'v'), length_of(views, 'u')};
  std::size_t dims[] = {length_of(views, 'y'), length_of(views, 'x'), length_of(views, 'c')};
  std::vector<std::uint8_t> samples = in_axes(views, "uvcxy");
  const char* fields[] = {"img"};
  const bool are_cells = form == Mat5Views::Cells;
  matvar_t* cells = are_cells ? Mat_VarCreate("LF", MAT_C_CELL, MAT_T_CELL, 2, grid, nullptr, 0)
                              : Mat_VarCreateStruct("LF", 2, grid, fields, 1);
  for (int i = 0; i < views.grid().count(); ++i) {
    std::uint8_t* view = samples.data() + static_cast<std::size_t>(i) * views.view_size();
    matvar_t* one = Mat_VarCreate(nullptr, MAT_C_UINT8, MAT_T_UINT8, 3, dims, view, 0);
    if (are_cells) Mat_VarSetCell(cells, i, one);
    if (!are_cells) Mat_VarSetStructFieldByName(cells, "img", static_cast<std::size_t>(i), one);
  }
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5);
  Mat_VarWrite(file, cells, is_compressed ? MAT_COMPRESSION_ZLIB : MAT_COMPRESSION_NONE);
  Mat_VarFree(cells);
  Mat_Close(file);
}

void write_mat5_map(const std::filesystem::path& path, const std::string& name,
                    ImageView<const float> map) {
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5);
  write_variable(file, map_variable(name, map), MAT_COMPRESSION_NONE);
  Mat_Close(file);
}

void write_deflated_zip(const std::filesystem::path& path, const std::vector<ZippedFile>& files) {
  std::string archive;
  std::string directory;
  for (const ZippedFile& file : files) {
    const std::string stored = deflated(file.bytes);
    const auto checksum =
        crc32_z(0, reinterpret_cast<const Bytef*>(file.bytes.data()), file.bytes.size());
    const std::string sizes = little_endian(checksum, 4) + little_endian(stored.size(), 4) +
                              little_endian(file.bytes.size(), 4) +
                              little_endian(file.name.size(), 2) + little_endian(0, 2);
    const std::string method = little_endian(0, 2) + little_endian(8, 2) + little_endian(0, 4);
    directory += "PK\1\2" + little_endian(20, 2) + little_endian(20, 2) + method + sizes +
                 little_endian(0, 10) + little_endian(archive.size(), 4) + file.name;
    archive += "PK\3\4" + little_endian(20, 2) + method + sizes + file.name + stored;
  }
  const std::size_t count = files.size();
  std::ofstream(path, std::ios::binary)
      << archive << directory << "PK\5\6" << little_endian(0, 4) << little_endian(count, 2)
      << little_endian(count, 2) << little_endian(directory.size(), 4)
      << little_endian(archive.size(), 4) << little_endian(0, 2);
}

std::string bytes_of_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace episcope::test
