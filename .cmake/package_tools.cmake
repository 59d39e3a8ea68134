# Read by cpack before it packs. Without these two, CPack fails without a reason, or makes a package that depends on nothing.
foreach(tool file dpkg-shlibdeps)
  find_program(found NAMES ${tool} NO_CACHE)
  if(NOT found)
    message(FATAL_ERROR "The Debian package needs ${tool}, by which its dependencies are found: apt-get install file dpkg-dev")
  endif()
  unset(found)
endforeach()
