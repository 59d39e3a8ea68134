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

# boresight_headers(NAME LINKS... HEADERS <...>...): headers that targets may take with boresight_precompiled(TARGET NAME).
function(boresight_headers name)
  cmake_parse_arguments(PARSE_ARGV 1 of "" "" "LINKS;HEADERS")
  if(NOT BORESIGHT_PRECOMPILED)
    return()
  endif()
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/headers/${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/headers/${name}.cpp)
  target_link_libraries(${name} PRIVATE ${of_LINKS})
  target_precompile_headers(${name} PRIVATE ${of_HEADERS})
  target_compile_options(${name} PRIVATE -fpch-preprocess)
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)
endfunction()

# What GCC 12 says of memory in its own std::string it says of precompiled headers too, where it no longer knows them for the system's.
function(boresight_precompiled target name)
  if(NOT BORESIGHT_PRECOMPILED)
    return()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${name})
  # -fpch-preprocess: ccache then sees which were used.
  target_compile_options(${target} PRIVATE -fpch-preprocess -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
endfunction()
