# What `cmake --install` puts where: libraries with their headers, a CMake package and pkg-config files. Parts that
# this build lacks (files, OpenGL) are left out. The command and its manual pages are installed by apps/duskline.
include(CMakePackageConfigHelpers)

set(duskline_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/duskline)

# Installs one library as duskline::EXPORT_NAME, its CMake target file and its pkg-config file.
#   DEPENDENCIES  pkg-config modules that a user of the static library links as well; a shared one brings them
#   REQUIRES      pkg-config modules whose headers ours include
function(duskline_install_library target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "EXPORT_NAME;DESCRIPTION" "REQUIRES;DEPENDENCIES")
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${arg_EXPORT_NAME})
  install(TARGETS ${target} EXPORT ${target} FILE_SET HEADERS)
  install(EXPORT ${target} NAMESPACE duskline:: FILE ${target}-targets.cmake DESTINATION ${duskline_package_dir})

  get_target_property(type ${target} TYPE)
  set(pc_requires ${arg_REQUIRES})
  if(type STREQUAL STATIC_LIBRARY)
    list(APPEND pc_requires ${arg_DEPENDENCIES})
  endif()
  list(JOIN pc_requires ", " pc_requires)
  set(pc_name ${target})
  set(pc_description ${arg_DESCRIPTION})
  # Seen from the .pc file, so that a prefix can be moved.
  file(RELATIVE_PATH pc_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/library.pc.in ${PROJECT_BINARY_DIR}/${target}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${target}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

set(duskline_modules tbb libhwy)
if(DUSKLINE_WITH_SUN)
  list(APPEND duskline_modules erfa)
endif()
duskline_install_library(duskline
  EXPORT_NAME duskline
  DESCRIPTION "Terrain shadows from elevation and light"
  DEPENDENCIES ${duskline_modules})

if(TARGET duskline_raster_io)
  set_target_properties(duskline_raster_io PROPERTIES INSTALL_RPATH "$ORIGIN")
  duskline_install_library(duskline_raster_io
    EXPORT_NAME raster_io
    DESCRIPTION "Elevation files for Duskline, read and written with GDAL"
    REQUIRES "duskline = ${PROJECT_VERSION}"
    DEPENDENCIES gdal libwebpmux libwebp)
endif()

if(TARGET duskline_gl)
  set_target_properties(duskline_gl PROPERTIES INSTALL_RPATH "$ORIGIN")
  duskline_install_library(duskline_gl
    EXPORT_NAME gl
    DESCRIPTION "Terrain shadows in OpenGL, for Duskline"
    REQUIRES "duskline = ${PROJECT_VERSION}"
    DEPENDENCIES epoxy)
  # For renderers that read their shaders from files.
  install(FILES src/duskline/gl/shaders/shadow_map.glsl src/duskline/gl/shaders/shadow_map_block.h
    src/duskline/gl/shaders/four_cells.glsl src/duskline/gl/shaders/visible_disc.glsl src/duskline/gl/shaders/terrain_shadow.glsl src/duskline/gl/shaders/terrain_shadow_block.h
    DESTINATION ${CMAKE_INSTALL_DATADIR}/duskline/shaders)
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/dusklineConfig.cmake.in
  ${PROJECT_BINARY_DIR}/dusklineConfig.cmake
  INSTALL_DESTINATION ${duskline_package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/dusklineConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/dusklineConfig.cmake ${PROJECT_BINARY_DIR}/dusklineConfigVersion.cmake
  DESTINATION ${duskline_package_dir})

if(TARGET duskline_command)
  file(RELATIVE_PATH libraries_from_programs ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  set_target_properties(duskline_command PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries_from_programs}")
  if(TARGET duskline_viewer)
    set_target_properties(duskline_viewer duskline_planet
      PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries_from_programs}")
  endif()
endif()

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
