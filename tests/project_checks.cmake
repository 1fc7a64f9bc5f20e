# Tests of the project itself rather than of its code.
find_package(Python3 REQUIRED COMPONENTS Interpreter)

add_test(NAME layers COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tools/check_layers.py ${PROJECT_SOURCE_DIR})
add_test(NAME layers_self_test COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/tools/check_layers_test.py)
# Links lead somewhere; what the pages quote is what the files say and the command prints.
if(DUSKLINE_BUILD_APPS)
  set(docs_command --duskline $<TARGET_FILE:duskline_command>)
endif()
add_test(NAME docs COMMAND Python3::Interpreter ${PROJECT_SOURCE_DIR}/tools/check_docs.py ${docs_command})
add_test(NAME docs_self_test COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/tools/check_docs_test.py)
add_test(NAME bench_table COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/tools/bench_table_test.py)
add_test(NAME compare_masks COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/tools/compare_masks_test.py)
set_tests_properties(layers layers_self_test docs docs_self_test bench_table compare_masks PROPERTIES ENVIRONMENT PYTHONDONTWRITEBYTECODE=1)

# 77 says that clang-format is not here. clang-tidy takes some minutes: .ci/run calls it.
add_test(NAME format COMMAND ${PROJECT_SOURCE_DIR}/tools/check_format.sh)
set_tests_properties(format PROPERTIES SKIP_RETURN_CODE 77)

if(DUSKLINE_SANITIZE MATCHES thread)
  add_executable(planted_race execution/planted_race.cpp)
  target_link_libraries(planted_race PRIVATE duskline::duskline duskline_warnings)
  add_test(NAME thread_sanitizer_finds_a_planted_race COMMAND planted_race)
  set_tests_properties(thread_sanitizer_finds_a_planted_race PROPERTIES
    PASS_REGULAR_EXPRESSION "data race.*planted_race.cpp")
endif()

if(DUSKLINE_BUILD_EXAMPLES)
  foreach(example hello_shadow point_in_shadow)
    add_test(NAME examples.${example} COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${example}>
      -D EXPECTED=${CMAKE_CURRENT_SOURCE_DIR}/examples/${example}.txt -P ${CMAKE_CURRENT_SOURCE_DIR}/expect_output.cmake)
  endforeach()
endif()
if(DUSKLINE_BUILD_EXAMPLES AND DUSKLINE_WITH_GL) # 5 says that there is no device for OpenGL
  set(picture ${CMAKE_CURRENT_BINARY_DIR}/shadow_in_a_renderer.ppm)
  add_test(NAME examples.shadow_in_a_renderer COMMAND shadow_in_a_renderer ${picture})
  add_test(NAME examples.picture_has_shadows_on_towers COMMAND Python3::Interpreter
    ${CMAKE_CURRENT_SOURCE_DIR}/examples/check_towers.py ${picture})
  set_tests_properties(examples.shadow_in_a_renderer PROPERTIES SKIP_RETURN_CODE 5 FIXTURES_SETUP rendered_picture)
  set_tests_properties(examples.picture_has_shadows_on_towers PROPERTIES SKIP_RETURN_CODE 77
    FIXTURES_REQUIRED rendered_picture)
endif()
if(DUSKLINE_INSTALL AND NOT DUSKLINE_SANITIZE)
  add_subdirectory(install)
endif()
