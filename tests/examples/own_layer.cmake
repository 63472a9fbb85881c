# Runs the example; then the stock program, which does not know the type, tells of the layer and lets it be.
# -DPROGRAM=... -DEXAMPLE=... -DWORK_DIR=...
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})
execute_process(COMMAND ${EXAMPLE} ${WORK_DIR}/heat.hmap ${WORK_DIR}/heat.png
                OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
set(expected "unread: 0 layers\nsame after load: yes\nwarm, 26 degrees\n"
             "8 cells in the area, 4 of them cold; 6 of 20 degrees\n2 primitives\n")
string(CONCAT expected ${expected})
string(FIND "${said}" "${expected}" found)
if(NOT found EQUAL 0)
  message(FATAL_ERROR "the example said: ${said}")
endif()
execute_process(COMMAND ${PROGRAM} info ${WORK_DIR}/heat.hmap
                RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE told)
if(NOT status EQUAL 1 OR NOT told MATCHES "TemperatureField")
  message(FATAL_ERROR "info ended with ${status}: ${told}")
endif()
