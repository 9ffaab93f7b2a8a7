// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"

#include <new>

namespace episcope {

std::string IoError::sentence() const {
  return std::string(what()).substr(path_.string().size() + 2);
}

std::string failure_text(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const std::bad_alloc&) {
    return kNotEnoughMemory;
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return kUnknownFailure;
  }
}

}  // namespace episcope
