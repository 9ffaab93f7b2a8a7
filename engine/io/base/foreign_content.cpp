// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/foreign_content.h"

#include "engine/core/text.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <string_view>

namespace episcope::io {
namespace {

using namespace std::string_view_literals;

constexpr const char* kFetch =
    "this is a pointer of Git LFS in place of the file; fetch the file by git lfs pull";
constexpr const char* kWebPage =
    "this is a web page in place of the file; download the file itself";
constexpr const char* kAnswer =
    "this is the answer of a server in place of the file, an error perhaps; download it again";
constexpr const char* kHeic = "HEIC pictures are not read; convert them to PNG or TIFF";
constexpr const char* kAvif = "AVIF pictures are not read; convert them to PNG or TIFF";
constexpr const char* kJpegXl = "JPEG XL pictures are not read; convert them to PNG or TIFF";
constexpr const char* kUnpack =
    "this is an archive of files; unpack it and open the folder that it makes";
constexpr const char* kPacked = "this file is compressed; unpack it, as by gunzip, and open that";
/// Of raw pictures under microlenses: the one place that says what to do with them.
constexpr const char* kDecode =
    "this is a raw picture of a Lytro camera; make a light field of it with episcope-cli decode";
constexpr const char* kSave =
    "this is an object that a program has saved for itself; save the array as .npy, .npz or .h5";
constexpr const char* kDocument = "this is a document; open the images that it was made of";

struct FirstBytes {
  std::size_t at;
  std::string_view bytes;  ///< In lower case.
  const char* advice;
};

/// Of several that fit, the first counts.
constexpr FirstBytes kForeign[] = {
    {0, "version https://git-lfs.github.com", kFetch},
    {0, "<!doctype html", kWebPage},
    {0, "<html", kWebPage},
    {0, "<?xml version=\"1.0\" encoding=\"utf-8\"?><error>", kAnswer},
    {4, "ftypheic", kHeic},
    {4, "ftypheix", kHeic},
    {4, "ftyphevc", kHeic},
    {4, "ftypmif1", kHeic},
    {4, "ftypmsf1", kHeic},
    {4, "ftypavif", kAvif},
    {4, "ftypavis", kAvif},
    {4, "jxl \x0d\x0a", kJpegXl},
    {0, "\xff\x0a", kJpegXl},
    {0, "\x89lfp\x0d\x0a\x1a\x0a", kDecode},
    {0, "pk\x03\x04", kUnpack},
    {0, "pk\x05\x06", kUnpack},
    {257, "ustar", kUnpack},
    {0, "7z\xbc\xaf\x27\x1c", kUnpack},
    {0, "rar!\x1a\x07", kUnpack},
    {0, "\x1f\x8b\x08", kPacked},
    {0, "\xfd\x37zxz\0"sv, kPacked},
    {0, "bzh", kPacked},
    {0, "\x28\xb5\x2f\xfd", kPacked},
    {0, "\x80\x02\x8a\x0al\xfc\x9c", kSave},
    {0, "\x80\x02}", kSave},
    {0, "\x80\x02]", kSave},
    {0, "\x80\x02\x63", kSave},
    {0, "\x80\x03}", kSave},
    {0, "\x80\x03]", kSave},
    {0, "\x80\x03\x63", kSave},
    {0, "\x80\x04\x95", kSave},
    {0, "\x80\x05\x95", kSave},
    {0, "%pdf-", kDocument}};

constexpr std::size_t kMostBytes = 512;

/// In lower case. Empty for what is no file: opening a pipe waits for whoever writes into it.
std::string first_bytes(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  std::ifstream file(path, std::ios::binary);
  std::array<char, kMostBytes> begin{};
  file.read(begin.data(), begin.size());
  return lower_case(std::string(begin.data(), static_cast<std::size_t>(file.gcount())));
}

/// Of a zip archive: PyTorch keeps its tensors in one, with a file "NAME/data.pkl" in front.
bool holds_pickle(std::string_view zip) {
  constexpr std::size_t kHeader = 30;
  constexpr std::size_t kLongestName = 128;
  return zip.starts_with("pk\x03\x04") && zip.size() > kHeader &&
         zip.substr(kHeader, kLongestName).find("/data.pkl") != std::string_view::npos;
}

}  // namespace

std::string foreign_content(const std::filesystem::path& path) {
  const std::string bytes = first_bytes(path);
  const std::string_view text =
      std::string_view(bytes).substr(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  if (holds_pickle(bytes)) return kSave;
  const auto known = std::ranges::find_if(kForeign, [&](const FirstBytes& one) {
    const std::string_view from = one.at == 0 && one.bytes[0] == '<' ? text : bytes;
    return from.size() > one.at && from.substr(one.at).starts_with(one.bytes);
  });
  if (known == std::end(kForeign)) return {};
  return known->advice == kUnpack && suffix_of(path) == ".npz" ? std::string() : known->advice;
}

}  // namespace episcope::io
