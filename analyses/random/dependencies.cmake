# What the room `random` needs beyond the other rooms: Random123 and Boost (Math, Random), both as headers only.
find_path(BORESIGHT_RANDOM123_INCLUDE Random123/philox.h REQUIRED)
find_path(BORESIGHT_BOOST_RANDOM_INCLUDE boost/random/sobol.hpp REQUIRED)
mark_as_advanced(BORESIGHT_RANDOM123_INCLUDE BORESIGHT_BOOST_RANDOM_INCLUDE)
