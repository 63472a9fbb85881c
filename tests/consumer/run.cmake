# Installs the build into a fresh prefix, looks for the manual there, builds the consumers and the examples against it and
# runs them; asks for a component that does not exist. Called with -DBUILD_DIR=... -DSOURCE_DIR=... -DWORK_DIR=...
# -DCXX=... -DCXX_FLAGS=...
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGV}\nended with ${status}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix)
foreach(file share/man/man1/hypermap.1 share/man/man1/hypermap-map.1 share/bash-completion/completions/hypermap)
  if(NOT EXISTS ${WORK_DIR}/prefix/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()
set(configure -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${CXX} "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}"
              -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix)
foreach(consumer all by_components examples)
  run(${CMAKE_COMMAND} -S ${SOURCE_DIR}/${consumer} -B ${WORK_DIR}/${consumer} ${configure})
  run(${CMAKE_COMMAND} --build ${WORK_DIR}/${consumer})
endforeach()
run(${WORK_DIR}/all/consumer)
run(${WORK_DIR}/by_components/consumer)
run(${CMAKE_COMMAND} -DPROGRAM=${WORK_DIR}/prefix/bin/hypermap -DEXAMPLES=${WORK_DIR}/examples
    -DWORK_DIR=${WORK_DIR}/examples/work -P ${SOURCE_DIR}/../examples/run.cmake)

# Sanitizer builds load libraries that they do not need.
if(NOT CXX_FLAGS MATCHES "-fsanitize")
  run(${CMAKE_COMMAND} -DPROGRAM=${WORK_DIR}/by_components/consumer -DFEWER_THAN=30
      -P ${SOURCE_DIR}/../support/count_libraries.cmake)
endif()

execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR}/by_components -B ${WORK_DIR}/unknown ${configure}
                        "-Dcomponents=core;sonar"
                RESULT_VARIABLE status ERROR_VARIABLE output OUTPUT_QUIET)
string(REGEX REPLACE "[ \n]+" " " output "${output}")
if(status EQUAL 0 OR NOT output MATCHES "there is no component 'sonar', there are: core, ")
  message(FATAL_ERROR "an unknown component ended with ${status}\n${output}")
endif()
