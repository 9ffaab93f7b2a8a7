// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/foreign_form.h"

#include "engine/core/text/suffix.h"

#include <string_view>

namespace episcope::io {
namespace {

struct Form {
  std::string_view suffix;
  const char* advice;
};

constexpr const char* kUnpack =
    "this is an archive of files; unpack it and open the folder that it makes";
constexpr const char* kDecode =
    "this is a raw picture of a Lytro camera; decode it, as LFToolbox does to a .mat file, or "
    "export "
    "it as ESLF image, and open that";
constexpr const char* kSave =
    "this is an object that a program has saved for itself; save the array as .npy, .npz or .h5";

constexpr const char* kConvert =
    "views are not read from GIF pictures, which hold 256 colours; use the originals, or convert "
    "them to PNG";

constexpr Form kForms[] = {
    {".zip", kUnpack}, {".tar", kUnpack}, {".gz", kUnpack},  {".tgz", kUnpack},
    {".xz", kUnpack},  {".bz2", kUnpack}, {".zst", kUnpack}, {".7z", kUnpack},
    {".rar", kUnpack}, {".lfp", kDecode}, {".lfr", kDecode}, {".lfx", kDecode},
    {".pt", kSave},    {".pth", kSave},   {".pkl", kSave},   {".pickle", kSave}};

}  // namespace

std::string advice_on(const std::filesystem::path& path) {
  const std::string suffix = suffix_of(path);
  for (const Form& form : kForms) {
    if (suffix == form.suffix) return form.advice;
  }
  return {};
}

std::string advice_on_folder(const std::filesystem::path& folder) {
  constexpr std::string_view kPicture = ".gif";
  std::string first;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string advice =
        suffix_of(entry.path()) == kPicture ? std::string(kConvert) : advice_on(entry.path());
    const std::string name = entry.path().filename().string();
    if (advice.empty() || (!first.empty() && first <= name + ": " + advice)) continue;
    first = name + ": " + advice;
  }
  return first;
}

}  // namespace episcope::io
