# boresight_test(NAME [SOURCES file...] [LINKS target...] [TIMEOUT seconds] [LONG seconds] [NIGHT seconds]): the program NAME and its tests, one of
# CTest for each. SOURCES: every .cpp of the folder, where none are given. LINKS: rooms (math) or other targets. Tests with "Long" in their name are
# labelled so and have LONG seconds instead of TIMEOUT (300). Those with "Night" in it run together, as Night.NAME, within NIGHT seconds and by
# `ctest -C Night` alone. In a new build folder the files of a program are compiled in batches, which takes less than half of the time; so what is
# not in a header stands in a namespace of its file's name.
include(GoogleTest)

# boresight_in_batches(TARGET SIZE): its files are compiled so many at once in a new build folder.
function(boresight_in_batches name size)
  if(BORESIGHT_TESTS_IN_BATCHES)
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${size})
    target_compile_options(${name} PRIVATE -Wno-shadow -Wshadow=local -Wno-subobject-linkage)
  endif()
endfunction()

function(boresight_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "" "TIMEOUT;LONG;NIGHT" "SOURCES;LINKS")
  if(NOT test_SOURCES)
    file(GLOB test_SOURCES CONFIGURE_DEPENDS *.cpp)
  endif()
  if(NOT test_TIMEOUT)
    set(test_TIMEOUT 300)
  endif()
  boresight_rooms_of(links ${test_LINKS})
  add_executable(${name} ${test_SOURCES})
  target_include_directories(${name} PRIVATE ${boresight_SOURCE_DIR}/tests ${boresight_SOURCE_DIR}/tests/lib ${boresight_SOURCE_DIR}/tests/analyses)
  target_link_libraries(${name} PRIVATE ${links} GTest::gmock_main)
  target_compile_definitions(${name} PRIVATE BORESIGHT_EXAMPLES="${boresight_SOURCE_DIR}/examples")
  boresight_in_batches(${name} 20)
  if(test_LONG)
    gtest_discover_tests(${name} TEST_FILTER "-*Long*:*Night*" PROPERTIES TIMEOUT ${test_TIMEOUT})
    gtest_discover_tests(${name} TEST_FILTER "*Long*-*Night*" TEST_LIST ${name}_long PROPERTIES TIMEOUT ${test_LONG} LABELS long COST 30)
  else()
    gtest_discover_tests(${name} TEST_FILTER "-*Night*" PROPERTIES TIMEOUT ${test_TIMEOUT})
  endif()
  if(test_NIGHT)
    add_test(NAME Night.${name} CONFIGURATIONS Night COMMAND ${name} "--gtest_filter=*Night*")
    set_tests_properties(Night.${name} PROPERTIES TIMEOUT ${test_NIGHT})
  endif()
endfunction()
