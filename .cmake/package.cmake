# What is installed: the rooms of lib and of analyses, each a component that find_package(boresight COMPONENTS lib analyses) asks for, and the
# program. `cpack --config build/release/CPackConfig.cmake` makes a Debian package of them, for which Debian's `file` and `dpkg-dev` find
# what it depends on; for other machines than this one, configure it with -DBORESIGHT_LANES=all.
include(CMakePackageConfigHelpers)
set(folder ${CMAKE_INSTALL_LIBDIR}/cmake/boresight)
set(installed_parts lib)
if(BORESIGHT_ANALYSES)
  list(APPEND installed_parts analyses)
endif()
foreach(part IN LISTS installed_parts)
  install(EXPORT ${part} FILE boresight-${part}.cmake NAMESPACE boresight:: DESTINATION ${folder} COMPONENT ${part})
endforeach()
configure_package_config_file(.cmake/boresightConfig.cmake.in ${CMAKE_BINARY_DIR}/boresightConfig.cmake INSTALL_DESTINATION ${folder})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/boresightConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_BINARY_DIR}/boresightConfig.cmake ${CMAKE_BINARY_DIR}/boresightConfigVersion.cmake DESTINATION ${folder} COMPONENT lib)
install(FILES LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT lib)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME boresight)
set(CPACK_PACKAGE_CONTACT "Boresight maintainers <maintainers@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libeigen3-dev, libgsl-dev, libtbb-dev, libceres-dev, libsqlite3-dev, libnlopt-cxx-dev, nlohmann-json3-dev")  # to build on the library
if(BORESIGHT_PYTHON)
  string(APPEND CPACK_DEBIAN_PACKAGE_RECOMMENDS ", python3, python3-numpy")  # what the Python package imports
endif()
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/package_tools.cmake)
include(CPack)
