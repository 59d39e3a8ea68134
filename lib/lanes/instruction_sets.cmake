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
get_target_property(sources lanes SOURCES)
foreach(kernel IN LISTS kernels)
  if(kernel IN_LIST built)
    string(TOUPPER ${kernel} upper)
    set_property(SOURCE ${CMAKE_CURRENT_LIST_DIR}/lane_kernels.cpp TARGET_DIRECTORY lanes
                 APPEND PROPERTY COMPILE_DEFINITIONS BORESIGHT_LANES_${upper})
  else()
    list(REMOVE_ITEM sources ${CMAKE_CURRENT_LIST_DIR}/lanes_${kernel}.cpp)
  endif()
endforeach()
set_property(TARGET lanes PROPERTY SOURCES ${sources})
set_property(SOURCE ${kernel_files} TARGET_DIRECTORY lanes
             APPEND PROPERTY COMPILE_OPTIONS -ffp-contract=off -fno-math-errno -fno-trapping-math
             -ffinite-math-only -fno-signed-zeros -Wno-psabi)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set_property(SOURCE ${CMAKE_CURRENT_LIST_DIR}/lanes_avx2.cpp TARGET_DIRECTORY lanes APPEND PROPERTY COMPILE_OPTIONS -march=x86-64-v3)
  set_property(SOURCE ${CMAKE_CURRENT_LIST_DIR}/lanes_avx512.cpp TARGET_DIRECTORY lanes
               APPEND PROPERTY COMPILE_OPTIONS -march=x86-64-v4 -mtune=icelake-server -mprefer-vector-width=512)
  include(CheckCXXCompilerFlag)
  check_cxx_compiler_flag("-mmove-max=512 -mstore-max=512" BORESIGHT_HAS_MOVE_MAX)  # GCC 12: copies of structs by whole registers
  if(BORESIGHT_HAS_MOVE_MAX)
    set_property(SOURCE ${CMAKE_CURRENT_LIST_DIR}/lanes_avx512.cpp TARGET_DIRECTORY lanes
                 APPEND PROPERTY COMPILE_OPTIONS -mmove-max=512 -mstore-max=512)
  endif()
  target_compile_definitions(lanes PRIVATE BORESIGHT_X86_LANES)
endif()  # elsewhere the compiler's generic vectors serve, and the wide kernels are built but not offered
