# cmake -D WRITE_SHADERS=program -D VALIDATOR=glslangValidator -D FOLDER=folder -P check_shaders.cmake
# Every stage in every variant is GLSL as the specification has it, whatever a driver lets pass.
file(REMOVE_RECURSE ${FOLDER})
execute_process(COMMAND ${WRITE_SHADERS} ${FOLDER} COMMAND_ERROR_IS_FATAL ANY)
file(GLOB shaders ${FOLDER}/*.glsl)
if(NOT shaders)
  message(FATAL_ERROR "no shaders to look at")
endif()
execute_process(COMMAND ${VALIDATOR} ${shaders} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${output}")
endif()
