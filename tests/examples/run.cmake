# Simulates a few frames and maps them with the example. -DSIMULATE=... -DEXAMPLE=... -DWORK_DIR=...
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})
execute_process(COMMAND ${SIMULATE} simulate --frames 4 --seed 1 --output ${WORK_DIR}/lab
                COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${EXAMPLE} ${WORK_DIR}/lab ${WORK_DIR}/lab.hmap
                OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
if(NOT said MATCHES "^4 frames, [0-9]+ objects\n$" OR NOT EXISTS ${WORK_DIR}/lab.hmap)
  message(FATAL_ERROR "the example said: ${said}")
endif()
