# boresight_one_entry(LIBRARY OBJECTS FUNCTION...): puts the one object of the object library OBJECTS into LIBRARY with all its symbols
# local but those of the functions boresight::FUNCTION.
#
# A header's inline functions and templates come out of every object that uses them as weak symbols, and the linker takes the
# first of a name for the whole program. Out of a kernel they are compiled for another processor and for finite numbers only: an
# older processor would meet instructions it does not know, and std::isfinite would be true of everything. Local symbols are
# nobody else's. The groups that weak symbols come in are dissolved first, for the linker joins groups of one name whatever
# their symbols say. tests/lib/lanes/symbol_guard.cmake holds this.
if(NOT CMAKE_LINKER OR NOT CMAKE_OBJCOPY)
  message(FATAL_ERROR "The kernels of the lanes need ld and objcopy (Debian: apt install binutils), found \"${CMAKE_LINKER}\" and \"${CMAKE_OBJCOPY}\"")
endif()

function(boresight_one_entry library objects)
  set_target_properties(${objects} PROPERTIES INTERPROCEDURAL_OPTIMIZATION OFF)  # objcopy needs machine code
  set(keep "")
  foreach(function IN LISTS ARGN)
    string(LENGTH ${function} length)
    list(APPEND keep "--keep-global-symbol=_ZN9boresight${length}${function}E*")  # as the Itanium ABI spells it
  endforeach()
  set(joined ${CMAKE_CURRENT_BINARY_DIR}/${objects}.joined.o)
  set(object ${CMAKE_CURRENT_BINARY_DIR}/${objects}.o)
  add_custom_command(
    OUTPUT ${object}
    COMMAND ${CMAKE_LINKER} -r --force-group-allocation -o ${joined} $<TARGET_OBJECTS:${objects}>
    COMMAND ${CMAKE_OBJCOPY} --wildcard ${keep} ${joined} ${object}
    COMMAND ${CMAKE_COMMAND} -E rm ${joined}
    DEPENDS $<TARGET_OBJECTS:${objects}>
    COMMENT "Making the symbols of ${objects} its own" COMMAND_EXPAND_LISTS VERBATIM)
  set_source_files_properties(${object} PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
  target_sources(${library} PRIVATE ${object})
endfunction()
