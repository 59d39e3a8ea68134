# Each kernel is compiled for its own processor and chosen when the program runs (lane_kernels.cpp). No reordering, and no fused
# multiply-add but where fused() asks for it: the kernels of processors that have one give the same bits, and so do those of
# processors that have none. Square roots need not set errno, which would keep them out of registers.
# There are only finite numbers and one zero, so that what is multiplied by a derivative known to be zero falls away; whether a
# step has left them is told by the bits (is_finite()).
set(kernels scalar sse2 avx2 avx512)
foreach(kernel IN LISTS kernels)
  list(APPEND kernel_files ${CMAKE_CURRENT_LIST_DIR}/lanes_${kernel}.cpp)
endforeach()
# A kernel takes minutes to compile. "native" builds this machine's widest and the one that every machine runs; packages, which go to
# other machines, say "all".
set(BORESIGHT_LANES native CACHE STRING "Kernels of the lanes that are built: native, all, or any of ${kernels}")
set(built ${BORESIGHT_LANES})
if(BORESIGHT_LANES STREQUAL "all")
  set(built ${kernels})
elseif(BORESIGHT_LANES STREQUAL "native")
  set(built scalar)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND EXISTS /proc/cpuinfo)
    file(STRINGS /proc/cpuinfo flags REGEX "^flags" LIMIT_COUNT 1)
    # As lane_kernels.cpp asks the processor.
    set(needs_avx512 avx512f avx512dq avx512vl avx512bw avx512cd fma)
    set(needs_avx2 avx2 fma bmi2)
    set(widest sse2)
    foreach(kernel avx2 avx512)
      set(has_all TRUE)
      foreach(flag IN LISTS needs_${kernel})
        if(NOT flags MATCHES " ${flag}( |$)")
          set(has_all FALSE)
        endif()
      endforeach()
      if(has_all)
        set(widest ${kernel})
      endif()
    endforeach()
    list(APPEND built ${widest})
  else()
    set(built ${kernels})  # nothing is known of it
  endif()
  message(STATUS "Kernels of the lanes, for this machine: ${built}")
endif()
foreach(kernel IN LISTS built)
  if(NOT kernel IN_LIST kernels)
    message(FATAL_ERROR "BORESIGHT_LANES: found \"${kernel}\", expected native, all, or any of ${kernels}")
  endif()
endforeach()
if(NOT built)
  message(FATAL_ERROR "BORESIGHT_LANES is empty; expected native, all, or any of ${kernels}")
endif()
# A kernel is an object of its own that exports its entry points and nothing else (one_entry.cmake says why).
set(kernel_options -ffp-contract=off -fno-math-errno -fno-trapping-math -ffinite-math-only -fno-signed-zeros -Wno-psabi)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND kernel_options -fno-gnu-unique)  # a kind of symbol that objcopy cannot make local
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(options_avx2 -march=x86-64-v3)
  set(options_avx512 -march=x86-64-v4 -mtune=icelake-server -mprefer-vector-width=512)
  include(CheckCXXCompilerFlag)
  check_cxx_compiler_flag("-mmove-max=512 -mstore-max=512" BORESIGHT_HAS_MOVE_MAX)  # GCC 12: copies of structs by whole registers
  if(BORESIGHT_HAS_MOVE_MAX)
    list(APPEND options_avx512 -mmove-max=512 -mstore-max=512)
  endif()
  target_compile_definitions(boresight_lanes PRIVATE BORESIGHT_X86_LANES)
endif()  # elsewhere the compiler's generic vectors serve, and the wide kernels are built but not offered
get_target_property(sources boresight_lanes SOURCES)
list(REMOVE_ITEM sources ${kernel_files})
set_property(TARGET boresight_lanes PROPERTY SOURCES ${sources})
include(${CMAKE_CURRENT_LIST_DIR}/one_entry.cmake)
foreach(kernel IN LISTS built)
  string(TOUPPER ${kernel} upper)
  set_property(SOURCE ${CMAKE_CURRENT_LIST_DIR}/lane_kernels.cpp TARGET_DIRECTORY boresight_lanes
               APPEND PROPERTY COMPILE_DEFINITIONS BORESIGHT_LANES_${upper})
  add_library(boresight_lanes_${kernel} OBJECT ${CMAKE_CURRENT_LIST_DIR}/lanes_${kernel}.cpp)
  set_target_properties(boresight_lanes_${kernel} PROPERTIES UNITY_BUILD OFF)  # one file, and known by its name
  target_link_libraries(boresight_lanes_${kernel} PRIVATE boresight::scene)
  target_compile_options(boresight_lanes_${kernel} PRIVATE ${kernel_options} ${options_${kernel}})
  boresight_one_entry(boresight_lanes boresight_lanes_${kernel} run_lanes_${kernel} run_lanes_${kernel}_single)
endforeach()
