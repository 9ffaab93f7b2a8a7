// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/run/failure_text.h"

#include <new>

namespace episcope {

std::string failure_text(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const std::bad_alloc&) {
    return "there is not enough memory; close other programs or remove results";
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace episcope
