# Fails unless a program loads fewer shared libraries than -DFEWER_THAN=..., as `ldd PROGRAM | wc -l` counts them.
# Called with -DPROGRAM=... -DFEWER_THAN=...
execute_process(COMMAND ldd ${PROGRAM} OUTPUT_VARIABLE libraries COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "\n" lines "${libraries}")
list(LENGTH lines count)
message(STATUS "${PROGRAM} loads ${count} shared libraries")
if(NOT count LESS FEWER_THAN)
  message(FATAL_ERROR "expected fewer than ${FEWER_THAN}:\n${libraries}")
endif()
