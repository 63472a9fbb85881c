# Runs the examples on a small simulation. -DPROGRAM=... -DEXAMPLES=<folder> -DWORK_DIR=...
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})
execute_process(COMMAND ${PROGRAM} simulate --frames 8 --seed 1 --output ${WORK_DIR}/lab
                COMMAND_ERROR_IS_FATAL ANY)

# run_example(<pattern of its output> <example> [arguments])
function(run_example expected example)
  execute_process(COMMAND ${EXAMPLES}/${example} ${ARGN} OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
  if(NOT said MATCHES "${expected}")
    message(FATAL_ERROR "${example} said: ${said}")
  endif()
endfunction()

set(map ${WORK_DIR}/lab.hmap)
run_example("^8 frames, [0-9]+ objects\n$" map_sequence ${WORK_DIR}/lab ${map})
run_example("layer [a-z]+: -?[0-9]+\n.*nearest: object [0-9]+, [1-9][0-9]* voxels" query_map ${map} chair)
run_example("^8 frames more, [1-9][0-9]* objects\n$" resume_map ${map} ${WORK_DIR}/lab)
run_example("^[1-9][0-9]* objects\n$" own_detector ${WORK_DIR}/lab)
run_example("^van at \\(1[0-4]\\.[0-9], [2-4]\\.[0-9]\\), [1-9][0-9]* voxels\n$" lidar_cloud)
run_example("^8 frames, [1-9][0-9]* grids, at most [1-9][0-9]* objects\n$" live_node ${WORK_DIR}/lab ${WORK_DIR}/live.hmap)
string(CONCAT layer_said "unread: 0 layers\nsame after load: yes\nwarm, 26 degrees\n"
              "8 cells in the area, 4 of them cold; 6 of 20 degrees\n2 primitives\n")
run_example("^${layer_said}" own_layer ${WORK_DIR}/heat.hmap ${WORK_DIR}/heat.png)

# The stock program, which does not know the type of the layer, tells of it and lets it be.
execute_process(COMMAND ${PROGRAM} info ${WORK_DIR}/heat.hmap
                RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE findings)
if(NOT status EQUAL 1 OR NOT findings MATCHES "TemperatureField")
  message(FATAL_ERROR "info ended with ${status}: ${findings}")
endif()
