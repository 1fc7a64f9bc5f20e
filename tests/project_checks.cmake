# Tests of the project itself rather than of its code.
find_package(Python3 REQUIRED COMPONENTS Interpreter)

add_test(NAME layers COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tools/check_layers.py ${PROJECT_SOURCE_DIR})
add_test(NAME layers_self_test COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/tools/check_layers_test.py)
set_tests_properties(layers layers_self_test PROPERTIES ENVIRONMENT PYTHONDONTWRITEBYTECODE=1)

if(DUSKLINE_BUILD_EXAMPLES)
  add_test(NAME examples.hello_shadow COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:hello_shadow>
    -D EXPECTED=${CMAKE_CURRENT_SOURCE_DIR}/examples/hello_shadow.txt -P ${CMAKE_CURRENT_SOURCE_DIR}/expect_output.cmake)
endif()
if(DUSKLINE_INSTALL AND NOT DUSKLINE_SANITIZE)
  add_subdirectory(install)
endif()
