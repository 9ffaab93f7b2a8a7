// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/streams.h"

#include "app/cli/arguments.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"

#include <poll.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <string_view>
#include <utility>

namespace episcope::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStream = "-";
constexpr int kLookAgain_ms = 100;
constexpr std::size_t kBlock = std::size_t{1} << 16;

std::string read_to_end(const std::stop_token& stop) {
  std::string bytes;
  std::array<char, kBlock> block{};
  for (;;) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (stop.stop_requested()) throw Cancelled();
    if (poll(&input, 1, kLookAgain_ms) == 0) continue;
    const ssize_t count = read(STDIN_FILENO, block.data(), block.size());
    if (count < 0) throw IoError(kStream, "standard input cannot be read; redirect a file to it");
    if (count == 0) return bytes;
    bytes.append(block.data(), static_cast<std::size_t>(count));
  }
}

const char* suffix_by_begin(std::string_view bytes) {
  constexpr std::pair<std::string_view, const char*> kBegins[] = {
      {"\x93NUMPY", ".npy"}, {"PK\x03\x04", ".npz"}, {"Pf", ".pfm"},   {"PF", ".pfm"},
      {"\x89HDF", ".h5"},    {"MATLAB", ".mat"},     {"II*", ".tiff"}, {"MM\0*", ".tiff"}};
  for (const auto& [begin, suffix] : kBegins) {
    if (bytes.starts_with(begin)) return suffix;
  }
  return ".csv";
}

/// A file for a stream, in a folder that is made for it.
std::string file_in(std::optional<HiddenFolder>& folder, const std::string& name) {
  std::error_code ignored;
  folder.emplace(fs::temp_directory_path(ignored) / "episcope");
  return folder->path() / name;
}

}  // namespace

InputStream::InputStream(std::string& name, const std::stop_token& stop) {
  if (name == kStream) read(name, stop);
}

InputStream::InputStream(std::vector<std::string>& names, const std::stop_token& stop) {
  const auto count = std::ranges::count(names, kStream);
  if (count > 1) throw UsageError("standard input can be read only once; give one - alone");
  if (count == 1) read(*std::ranges::find(names, kStream), stop);
}

void InputStream::read(std::string& name, const std::stop_token& stop) {
  const std::string bytes = read_to_end(stop);
  if (bytes.empty()) throw IoError(kStream, "standard input is empty; redirect a file to it");
  file_ = file_in(folder_, std::string("stdin") + suffix_by_begin(bytes));
  std::ofstream out(file_, std::ios::binary);
  if (!out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush()) {
    throw io::write_error(file_);
  }
  name = file_;
}

void InputStream::require_light_field() const {
  const std::string suffix = suffix_of(file_);
  if (suffix != ".csv" && suffix != ".pfm") return;
  throw IoError(kStream,
                "standard input holds no light field of a form that can be piped, which are HDF5, "
                ".npy, .npz, .mat and TIFF; name its file or folder instead");
}

void require_no_other_source(const fs::path& output, Overwrite overwrite) {
  if (overwrite == Overwrite::Yes || !holds_something(output)) return;
  throw IoError(output, std::string("exists and does not tell whether it is of what is piped; "
                                    "choose another name, or ") +
                            kByOption);
}

OutputStream::OutputStream(std::string& name, const std::string& suffix) {
  if (name != kStream && !name.ends_with(":-")) return;
  const std::string form = name == kStream ? suffix : "." + name.substr(0, name.size() - 2);
  file_ = file_in(folder_, "stdout" + form);
  name = file_;
}

void OutputStream::send() const {
  std::ifstream in(file_, std::ios::binary);
  std::cout << in.rdbuf();
  if (!std::cout.flush()) throw IoError(kStream, "standard output cannot be written");
}

void OutputStream::require_alone(bool is_json) const {
  if (!is_meant() || !is_json) return;
  throw UsageError("the map goes to standard output, and so would --json; leave one of them out");
}

}  // namespace episcope::cli
