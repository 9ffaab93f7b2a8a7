# Release builds: checked copies, position independent, read-only relocations; and the same bytes
# wherever the sources lie. Included before any target is added.
option(EPISCOPE_HARDENED "Harden release builds" ON)
if(EPISCOPE_HARDENED)
  string(APPEND CMAKE_CXX_FLAGS_RELEASE
         " -fPIE -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2"
         " -ffile-prefix-map=${CMAKE_BINARY_DIR}/=build/ -ffile-prefix-map=${CMAKE_SOURCE_DIR}/=")
  string(APPEND CMAKE_EXE_LINKER_FLAGS_RELEASE " -pie -Wl,-z,relro,-z,now")
endif()
