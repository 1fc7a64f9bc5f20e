# Builds a foreign project that uses Duskline, runs its program and looks at what it prints.
#
# cmake -D CXX=compiler -D BINARY=folder and either
#   -D SOURCE=folder [-D OPTIONS=list]   a CMake project, configured with these options, or
#   -D PKG_CONFIG=program -D PREFIX=...  the consumer by pkg-config from that prefix
# and, where Duskline reads files, -D WITH_FILES=ON; -P consume.cmake
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif()
  set(output ${output} PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${BINARY})
file(MAKE_DIRECTORY ${BINARY})
if(SOURCE)
  run(${CMAKE_COMMAND} -S ${SOURCE} -B ${BINARY} -G Ninja -DCMAKE_CXX_COMPILER=${CXX} ${OPTIONS})
  run(${CMAKE_COMMAND} --build ${BINARY})
else()
  file(GLOB_RECURSE package ${PREFIX}/*/duskline.pc)
  get_filename_component(package_dir ${package} DIRECTORY)
  get_filename_component(library_dir ${package_dir} DIRECTORY)
  set(ENV{PKG_CONFIG_PATH} ${package_dir})
  function(build_with_pkg_config module source program)
    run(${PKG_CONFIG} --cflags --libs ${module})
    separate_arguments(flags UNIX_COMMAND "${output}")
    run(${CXX} -std=c++20 ${CMAKE_CURRENT_LIST_DIR}/consumer/${source} -o ${BINARY}/${program} ${flags}
      -Wl,-rpath,${library_dir})
  endfunction()
  build_with_pkg_config(duskline main.cpp consumer)
  if(WITH_FILES)
    build_with_pkg_config(duskline_raster_io from_file.cpp consumer_of_files)
  endif()
endif()

function(expect_ten_cells)
  run(${ARGN})
  if(NOT output MATCHES "^([a-z_-]+: 10 cells\n)+$")
    message(FATAL_ERROR "${ARGN} should print ten cells for every caster, and printed\n${output}")
  endif()
endfunction()
expect_ten_cells(${BINARY}/consumer)
if(WITH_FILES)
  expect_ten_cells(${BINARY}/consumer_of_files ${CMAKE_CURRENT_LIST_DIR}/consumer/wall.asc)
endif()
