# What the room `statistics` needs beyond the other rooms: GSL, and Boost.Math as headers only.
find_package(GSL REQUIRED)
find_path(BORESIGHT_BOOST_MATH_INCLUDE boost/math/distributions/binomial.hpp REQUIRED)
mark_as_advanced(BORESIGHT_BOOST_MATH_INCLUDE)
target_link_libraries(statistics PRIVATE GSL::gsl)
