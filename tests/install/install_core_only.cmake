# cmake -D CXX=compiler -D SOURCE=project -D BINARY=folder -D PREFIX=folder -P install_core_only.cmake
# Builds the core as a static library, without what it does not need, and installs it.
function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${result}:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${PREFIX})
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${BINARY} --preset core-only -DCMAKE_CXX_COMPILER=${CXX}
  -DCMAKE_BUILD_TYPE=Debug -DBUILD_SHARED_LIBS=OFF -DDUSKLINE_BUILD_TESTS=OFF -DDUSKLINE_BUILD_EXAMPLES=OFF)
run(${CMAKE_COMMAND} --build ${BINARY})
run(${CMAKE_COMMAND} --install ${BINARY} --prefix ${PREFIX})
