# Headers of other libraries, parsed once for all files: they take half of every compilation. Own headers are not among them, so
# that a change compiles again what includes it and nothing else. Every file still includes what it uses: the builds of .ci/deep go
# without. GCC only, as that is what was measured.
set(precompiled_by_default OFF)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(precompiled_by_default ON)
endif()
option(BORESIGHT_PRECOMPILED "Parse the headers of other libraries once for all files" ${precompiled_by_default})

set(BORESIGHT_STANDARD_HEADERS <algorithm> <array> <chrono> <cmath> <filesystem> <fstream> <functional> <limits> <map> <memory> <numbers>
    <optional> <random> <set> <span> <sstream> <stdexcept> <string> <string_view> <vector>)
set(BORESIGHT_EIGEN_HEADERS <Eigen/Core> <Eigen/Geometry> <Eigen/LU> <Eigen/QR> <Eigen/Cholesky>)

# Where a program spends no time - its command line, its reports, its tests - half an optimisation takes 0.57 of the time that a whole one takes to
# compile (measured on tests). In a list of compile options, after the build type's own -O3.
set(BORESIGHT_HALF_OPTIMISED $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU,Clang>>:-O1>)

# boresight_headers(NAME [HALF_OPTIMISED] LINKS... HEADERS <...>...): headers that targets may take with boresight_precompiled(TARGET NAME), which are
# optimised as these are: GCC 12 keeps that with the headers, and breaks where it differs.
function(boresight_headers name)
  cmake_parse_arguments(PARSE_ARGV 1 of "HALF_OPTIMISED" "" "LINKS;HEADERS")
  if(NOT BORESIGHT_PRECOMPILED)
    return()
  endif()
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/headers/${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/headers/${name}.cpp)
  target_link_libraries(${name} PRIVATE ${of_LINKS})
  target_precompile_headers(${name} PRIVATE ${of_HEADERS})
  target_compile_options(${name} PRIVATE -fpch-preprocess)
  if(of_HALF_OPTIMISED)
    target_compile_options(${name} PRIVATE ${BORESIGHT_HALF_OPTIMISED})
    set_target_properties(${name} PROPERTIES BORESIGHT_OPTIMISED "${BORESIGHT_HALF_OPTIMISED}")
  endif()
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)
endfunction()

# What GCC 12 says of memory in its own std::string it says of precompiled headers too, where it no longer knows them for the system's.
function(boresight_precompiled target name)
  if(NOT BORESIGHT_PRECOMPILED)
    return()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${name})
  # -fpch-preprocess: ccache then sees which were used.
  get_target_property(optimised ${name} BORESIGHT_OPTIMISED)
  if(optimised)
    target_compile_options(${target} PRIVATE ${optimised})
  endif()
  target_compile_options(${target} PRIVATE -fpch-preprocess -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
endfunction()
