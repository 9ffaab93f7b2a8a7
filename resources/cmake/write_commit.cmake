# Writes the source OUT that says which commit of SOURCE is built; leaves it alone if it says so.
set(commit unknown)
find_program(GIT git)
if(GIT)
  # Of SOURCE itself, not of a checkout in which an unpacked archive happens to lie.
  execute_process(COMMAND "${GIT}" -C "${SOURCE}" rev-parse --show-toplevel OUTPUT_VARIABLE top
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  file(REAL_PATH "${SOURCE}" source)
  if(top STREQUAL source)
    execute_process(COMMAND "${GIT}" -C "${SOURCE}" describe --always --dirty --tags
                    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(described)
      set(commit "${described}")
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT "${OUT}" @ONLY CONTENT [[
#include "app/about/version_text.h"

namespace episcope {

const char* const kCommit = "@commit@";

}  // namespace episcope
]])
