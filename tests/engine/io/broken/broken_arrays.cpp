// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/write_arrays.h"
#include "tests/engine/io/broken/broken.h"
#include "tests/engine/io/formats/array_files.h"
#include "tests/engine/io/synthetic_scene.h"

#include <zlib.h>

#include <fstream>

namespace episcope::test {
namespace in_broken_arrays {

namespace fs = std::filesystem;

using Make = std::function<fs::path(const fs::path&)>;

Scene small_scene() {
  return plane_scene({.grid = {3, 3}, .height = 8, .width = 9});
}

/// The text of an .npy file: its header, as NumPy writes it, and `bytes` samples.
std::string npy_bytes(const std::string& type, const std::string& shape, std::size_t bytes,
                      const std::string& order = "False") {
  std::string header =
      "{'descr': '" + type + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }";
  header.resize((header.size() + 10 + 64) / 64 * 64 - 11, ' ');
  header += '\n';
  std::string text("\x93NUMPY\x01\x00", 8);
  text += static_cast<char>(header.size() & 0xFF);
  text += static_cast<char>(header.size() >> 8);
  return text + header + std::string(bytes, '\1');
}

fs::path write(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

Make npy(const std::string& type, const std::string& shape, std::size_t bytes) {
  return [=](const fs::path& f) { return write(f / "lf.npy", npy_bytes(type, shape, bytes)); };
}

/// A file of this name with the beginning of a good one.
Make cut(const char* name, void (*write_good)(const fs::path&, const Scene&, const Progress&),
         double share) {
  return [=](const fs::path& f) {
    write_good(f / name, small_scene(), Progress(1));
    const auto whole = static_cast<double>(fs::file_size(f / name));
    fs::resize_file(f / name, static_cast<std::uintmax_t>(whole * share));
    return f / name;
  };
}

fs::path npz(const fs::path& folder, const std::vector<ZippedFile>& files) {
  write_deflated_zip(folder / "lf.npz", files);
  return folder / "lf.npz";
}

/// A zip archive whose first entry names a method of compression that nobody knows.
fs::path npz_of_unknown_method(const fs::path& folder) {
  const fs::path path = npz(folder, {{"lf.npy", npy_bytes("|u1", "(3, 3, 8, 9, 3)", 1944)}});
  std::string bytes = bytes_of_file(path);
  for (const auto& [signature, offset] :
       {std::pair(std::string("PK\x03\x04"), 8), std::pair(std::string("PK\x01\x02"), 10)}) {
    bytes[bytes.find(signature) + static_cast<std::size_t>(offset)] = 99;
  }
  return write(path, bytes);
}

std::string zlib_packed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  packed.resize(size);
  return packed;
}

fs::path cut_mat5(const fs::path& folder, bool is_compressed, double share) {
  const Scene scene = small_scene();
  const fs::path path = folder / "lf.mat";
  write_mat5(path, bytes_of(scene), {.is_compressed = is_compressed});
  const auto whole = static_cast<double>(fs::file_size(path));
  fs::resize_file(path, static_cast<std::uintmax_t>(whole * share));
  return path;
}

/// A MATLAB 5 file of one variable that is not compressed, with it compressed.
std::string packed_mat5(const std::string& bytes) {
  const std::string packed = zlib_packed(bytes.substr(128));
  std::string tag("\x0f\0\0\0", 4);
  for (std::size_t i = 0; i < 4; ++i) tag += static_cast<char>(packed.size() >> 8 * i);
  return bytes.substr(0, 128) + tag + packed;
}

/// The lengths of its dimensions take 4 GB, says the file: what a fuzzer found.
fs::path mat5_of_long_dimensions(const fs::path& folder, bool is_compressed) {
  const fs::path path = folder / "lf.mat";
  write_mat5(path, bytes_of(small_scene()), {});
  std::string bytes = bytes_of_file(path);
  bytes.replace(156, 4, "\x06\xff\xff\xfe");
  return write(path, is_compressed ? packed_mat5(bytes) : bytes);
}

/// Likewise those of its second cell.
fs::path mat5_of_long_cell(const fs::path& folder) {
  const fs::path path = folder / "lf.mat";
  write_mat5_cells(path, bytes_of(small_scene()), false);
  std::string bytes = bytes_of_file(path);
  const std::string dimensions("\x05\0\0\0\x0c\0\0\0", 8);
  const auto first = bytes.find(dimensions);
  bytes.replace(bytes.find(dimensions, first + 1) + 4, 4, "\x06\xff\xff\x7e");
  return write(path, packed_mat5(bytes));
}

std::vector<Broken> broken_npy() {
  const char* const whole = "(3, 3, 8, 9, 3)";
  return {
      {".npy that is text", [](const fs::path& f) { return write(f / "lf.npy", "1, 2, 3"); }, ""},
      {".npy that is empty", [](const fs::path& f) { return write(f / "lf.npy", ""); }, ""},
      {".npy that ends in its header",
       [](const fs::path& f) {
         return write(f / "lf.npy", npy_bytes("|u1", "(3, 3, 8, 9, 3)", 0).substr(0, 40));
       },
       ""},
      {".npy without all of its samples", npy("|u1", whole, 1000), ""},
      {".npy of 10^12 samples in 200 bytes", npy("|u1", "(10, 10, 60000, 60000, 3)", 72), ""},
      {".npy of more samples than there are numbers",
       npy("<f8", "(4294967296, 4294967296, 4294967296, 9, 3)", 72), ""},
      {".npy of negative size", npy("|u1", "(-3, 3, 8, 9, 3)", 1944), ""},
      {".npy of pickled objects", npy("|O", whole, 1944), ""},
      {".npy of text", npy("<U5", whole, 40000), ""},
      {".npy of complex numbers", npy("<c16", whole, 40000), ""},
      {".npy of records", npy("[('a', '<f4')]", whole, 40000), ""},
      {".npy without samples", npy("|u1", "(0, 3, 8, 9, 3)", 0), ""},
      {".npy of one axis", npy("|u1", "(1944,)", 1944), ""},
      {".npy of seven axes", npy("|u1", "(2, 2, 3, 3, 8, 9, 3)", 7776), ""},
      {".npy of seven channels", npy("|u1", "(3, 3, 8, 9, 7)", 4536), ""},
      {".npy that calls a function as its shape", npy("|u1", "__import__(os).abort()", 1944), ""},
  };
}

}  // namespace in_broken_arrays

std::vector<Broken> broken_arrays() {
  using namespace in_broken_arrays;
  std::vector<Broken> all = broken_npy();
  const std::vector<Broken> others = {
      {".npz that is cut", cut("lf.npz", io::write_npz, 0.5), ""},
      {".npz that is text", [](const fs::path& f) { return write(f / "lf.npz", "1, 2, 3"); }, ""},
      {".npz without arrays",
       [](const fs::path& f) {
         return npz(f, {{"a.txt", "text"}});
       },
       ""},
      {".npz of nothing", [](const fs::path& f) { return npz(f, {}); }, ""},
      {".npz of pickled objects",
       [](const fs::path& f) {
         return npz(f, {{"lf.npy", npy_bytes("|O", "(3, 3, 8, 9, 3)", 1944)}});
       },
       ""},
      {".npz whose array claims more than it unpacks to",
       [](const fs::path& f) {
         return npz(f, {{"lf.npy", npy_bytes("|u1", "(10, 10, 60000, 60000, 3)", 72)}});
       },
       ""},
      {".npz packed by an unknown method", npz_of_unknown_method, ""},
      {".mat that is text", [](const fs::path& f) { return write(f / "lf.mat", "1, 2, 3"); }, ""},
      {".mat 7.3 that is cut in its header", cut("lf.mat", io::write_mat, 0.05), ""},
      {".mat 7.3 that is cut in its samples", cut("lf.mat", io::write_mat, 0.6), ""},
      {".mat 5 that is cut", [](const fs::path& f) { return cut_mat5(f, false, 0.5); }, ""},
      {".mat 5 that is cut and compressed",
       [](const fs::path& f) { return cut_mat5(f, true, 0.5); }, ""},
      {".mat 5 whose dimensions are long",
       [](const fs::path& f) { return mat5_of_long_dimensions(f, false); }, "damaged"},
      {".mat 5 whose dimensions are long, compressed",
       [](const fs::path& f) { return mat5_of_long_dimensions(f, true); }, "damaged"},
      {".mat 5 whose second cell has long dimensions, compressed", mat5_of_long_cell, "damaged"},
      {".mat 5 that ends in its header", [](const fs::path& f) { return cut_mat5(f, false, 0.04); },
       ""},
  };
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

}  // namespace episcope::test
