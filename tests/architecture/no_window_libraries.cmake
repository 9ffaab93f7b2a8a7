# PROGRAM must load neither Qt nor VTK.
execute_process(COMMAND "${LDD}" "${PROGRAM}" OUTPUT_VARIABLE libraries COMMAND_ERROR_IS_FATAL ANY)
if(NOT libraries MATCHES "libc\\.so")
  message(FATAL_ERROR "ldd does not list the libraries of ${PROGRAM}:\n${libraries}")
endif()
string(REGEX MATCHALL "lib(Qt|vtk)[^ ]*" found "${libraries}")
if(found)
  message(FATAL_ERROR "${PROGRAM} loads ${found}")
endif()
