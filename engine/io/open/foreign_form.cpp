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

}  // namespace episcope::io
