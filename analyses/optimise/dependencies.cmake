# What the room `optimise` needs beyond the other rooms: NLopt's C++ interface, and oneTBB.
find_path(BORESIGHT_NLOPT_INCLUDE nlopt.hpp REQUIRED)
find_library(BORESIGHT_NLOPT_LIBRARY NAMES nlopt_cxx nlopt REQUIRED)
mark_as_advanced(BORESIGHT_NLOPT_INCLUDE BORESIGHT_NLOPT_LIBRARY)
target_include_directories(optimise PRIVATE ${BORESIGHT_NLOPT_INCLUDE})
target_link_libraries(optimise PRIVATE ${BORESIGHT_NLOPT_LIBRARY} TBB::tbb)
