# Builds and runs the consumer, copied outside the tree, by one ROUTE. Used by ctest.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT status EQUAL 0)
    string(JOIN " " line ${ARGV})
    message(FATAL_ERROR "${line}\n${out}")
  endif()
  set(out "${out}" PARENT_SCOPE)
endfunction()

set(work $ENV{TMPDIR})
if(NOT work)
  set(work /tmp)
endif()
string(MD5 key ${CAROM_BUILD})
set(work ${work}/carom-consumer-${key})
file(MAKE_DIRECTORY ${work})
file(COPY ${CAROM_SOURCE}/tests/consumers/main.cpp ${CAROM_SOURCE}/tests/consumers/CMakeLists.txt
  DESTINATION ${work})

set(build ${work}/build)
if(ROUTE STREQUAL "find_package")
  set(build ${work}/build-installed)
  run(${CMAKE_COMMAND} --install ${CAROM_BUILD} --prefix ${work}/prefix)
  set(prefix ${work}/prefix)
  if(EXISTS ${prefix}/carom/cpp)  # as in a wheel
    string(APPEND prefix /carom/cpp)
  endif()
  set(installed -DCMAKE_PREFIX_PATH=${prefix})
endif()
run(${CMAKE_COMMAND} -S ${work} -B ${build} -G ${GENERATOR} -DROUTE=${ROUTE}
  -DCMAKE_MAKE_PROGRAM=${MAKE_PROGRAM} -DCMAKE_CXX_FLAGS=${CXX_FLAGS}
  -DCAROM_SOURCE=${CAROM_SOURCE} -DEigen3_DIR=${EIGEN_DIR} ${installed})
run(${CMAKE_COMMAND} --build ${build} --target app -j 2)
run(${build}/app)
message("${ROUTE}: ${out}")
if(LAST)
  file(REMOVE_RECURSE ${work})
endif()
