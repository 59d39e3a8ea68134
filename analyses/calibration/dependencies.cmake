# What the room `calibration` needs beyond the other rooms: Ceres, and Boost.Math for quantiles, headers only.
find_package(Ceres REQUIRED)
target_link_libraries(calibration PUBLIC Ceres::ceres)
