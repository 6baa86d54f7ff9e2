# Installs the library for find_package(Linkwright): one target a module (Linkwright::planar ...) and
# Linkwright::linkwright, which is all of them without the extras (Linkwright::pagmo_adapters); add_subdirectory gives the same names.

get_property(modules GLOBAL PROPERTY LINKWRIGHT_MODULES)
list(REMOVE_ITEM modules linkwright_cli linkwright_serve)
get_property(extras GLOBAL PROPERTY LINKWRIGHT_EXTRAS)
add_library(linkwright_all INTERFACE)
target_link_libraries(linkwright_all INTERFACE ${modules})
set_target_properties(linkwright_all PROPERTIES EXPORT_NAME linkwright)
add_library(Linkwright::linkwright ALIAS linkwright_all)

option(LINKWRIGHT_INSTALL "Add install rules" ${PROJECT_IS_TOP_LEVEL})
if(NOT LINKWRIGHT_INSTALL)
  return()
endif()

include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Linkwright)

# Components: program (what who runs it needs) and development (headers, libraries, packages of CMake and pkg-config).
if(TARGET linkwright)
  install(TARGETS linkwright RUNTIME COMPONENT program)
  # What the program says of itself (src/linkwright/cli/CMakeLists.txt), where man, bash, zsh and fish look for it.
  if(NOT CMAKE_CROSSCOMPILING)
    set(described ${PROJECT_BINARY_DIR}/described)
    install(FILES ${described}/linkwright.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
    install(FILES ${described}/linkwright DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
    install(FILES ${described}/_linkwright DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT program)
    install(FILES ${described}/linkwright.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
  endif()
endif()
install(TARGETS ${modules} ${extras} linkwright_all EXPORT LinkwrightTargets ARCHIVE COMPONENT development)
install(DIRECTORY src/linkwright DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development FILES_MATCHING PATTERN "*.h" PATTERN detail EXCLUDE)
install(EXPORT LinkwrightTargets NAMESPACE Linkwright:: DESTINATION ${package_dir} COMPONENT development)

get_property(requirements GLOBAL PROPERTY LINKWRIGHT_REQUIREMENTS)
list(REMOVE_DUPLICATES requirements)
list(TRANSFORM requirements PREPEND "find_dependency(")
list(TRANSFORM requirements APPEND ")")
list(JOIN requirements "\n" LINKWRIGHT_FIND_DEPENDENCIES)
configure_package_config_file(cmake/LinkwrightConfig.cmake.in LinkwrightConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(LinkwrightConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/LinkwrightConfig.cmake ${PROJECT_BINARY_DIR}/LinkwrightConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FindSundialsSerial.cmake
        DESTINATION ${package_dir} COMPONENT development)

# pkg-config linkwright: the mechanics, without study files and reports.
set(pc_libraries)
foreach(module parameter_study clearance flexible parallel suspension planar optimise math core)
  if(TARGET linkwright_${module})
    string(APPEND pc_libraries " -llinkwright_${module}")
  endif()
endforeach()
string(STRIP "${pc_libraries}" pc_libraries)
set(pc_requires "fmt, eigen3")
if(LINKWRIGHT_TBB)
  string(APPEND pc_requires ", tbb")
endif()
set(pc_others "-lsundials_arkode -lsundials_cvode")
if(LINKWRIGHT_NLOPT)
  string(APPEND pc_requires ", nlopt")
endif()
if(LINKWRIGHT_PAGMO)
  string(PREPEND pc_others "-lpagmo -lboost_serialization ")
endif()
file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(cmake/linkwright.pc.in linkwright.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/linkwright.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
