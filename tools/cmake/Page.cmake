# SPDX-License-Identifier: Apache-2.0
# The configurator: one HTML file with the pure libraries as WebAssembly. Needs clang, lld, wasi-libc, libc++-dev-wasm32,
# libclang-rt-dev-wasm32, esbuild and python3; nothing else of the project needs them.
option(DPSLAVE_CONFIGURATOR "Build the page of the GSD configurator" OFF)
if(NOT DPSLAVE_CONFIGURATOR)
  return()
endif()

include(ExternalProject)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
set(page_core ${PROJECT_BINARY_DIR}/page/core/core.wasm)
ExternalProject_Add(page_core
  SOURCE_DIR ${PROJECT_SOURCE_DIR}/src/page
  BINARY_DIR ${PROJECT_BINARY_DIR}/page/core
  PREFIX ${PROJECT_BINARY_DIR}/page/steps
  CMAKE_GENERATOR Ninja
  CMAKE_ARGS -DCMAKE_TOOLCHAIN_FILE=${PROJECT_SOURCE_DIR}/tools/cmake/wasm32-wasi.cmake -DCMAKE_BUILD_TYPE=MinSizeRel
  BUILD_ALWAYS ON
  BUILD_BYPRODUCTS ${page_core}
  INSTALL_COMMAND "")

set(page ${PROJECT_BINARY_DIR}/page/configurator.html)
file(GLOB_RECURSE page_parts CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/src/page/*.js ${PROJECT_SOURCE_DIR}/src/page/*.css ${PROJECT_SOURCE_DIR}/src/page/*.html
  ${PROJECT_SOURCE_DIR}/src/page/page.py ${PROJECT_SOURCE_DIR}/config/profiles/*.toml ${PROJECT_SOURCE_DIR}/config/tags/*.csv
  ${PROJECT_SOURCE_DIR}/gsd/mappings/*.toml)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/page/link)
add_custom_command(OUTPUT ${page}
  COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/src/page/page.py ${PROJECT_SOURCE_DIR} ${page_core} ${page}
  DEPENDS page_core ${page_core} ${page_parts}
  COMMENT "Putting the configurator's page together"
  VERBATIM)
add_custom_target(configurator ALL DEPENDS ${page})

# The menu of the desktop, and that of Cockpit, which must know the hashes of the page.
set(page_manifest ${PROJECT_BINARY_DIR}/page/manifest.json)
add_custom_command(OUTPUT ${page_manifest}
  COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/src/page/cockpit_manifest.py ${page} ${page_manifest}
  DEPENDS ${page} ${PROJECT_SOURCE_DIR}/src/page/cockpit_manifest.py
  VERBATIM)
add_custom_target(configurator_manifest ALL DEPENDS ${page_manifest})
add_dependencies(configurator_manifest configurator)
set(cockpit_folder ${CMAKE_INSTALL_DATADIR}/cockpit/dpslaved-configurator)
install(FILES ${page} DESTINATION ${CMAKE_INSTALL_DATADIR}/dpslaved COMPONENT configurator)
install(FILES ${PROJECT_SOURCE_DIR}/src/page/menu/dpslaved-configurator.desktop
  DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT configurator)
install(FILES ${PROJECT_SOURCE_DIR}/src/page/menu/dpslaved-configurator.svg
  DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT configurator)
install(FILES ${page_manifest} DESTINATION ${cockpit_folder} COMPONENT configurator)
file(CREATE_LINK ../../dpslaved/configurator.html ${PROJECT_BINARY_DIR}/page/link/configurator.html SYMBOLIC)
install(FILES ${PROJECT_BINARY_DIR}/page/link/configurator.html DESTINATION ${cockpit_folder} COMPONENT configurator)
