// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/durable/make_folder.h"

#include "engine/core/error.h"

#include <string>
#include <system_error>

namespace episcope::io {

void make_folder(const std::filesystem::path& folder, std::string_view advice) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (!failure) return;
  throw IoError(folder,
                "the folder cannot be created (" + failure.message() + ")" + std::string(advice));
}

}  // namespace episcope::io
