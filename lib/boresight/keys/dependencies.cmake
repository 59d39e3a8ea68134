# What the room `keys` needs beyond the other rooms: UDUNITS-2.
find_path(BORESIGHT_UDUNITS_INCLUDE udunits2.h REQUIRED)
mark_as_advanced(BORESIGHT_UDUNITS_INCLUDE)
target_link_libraries(boresight_keys PRIVATE udunits2)
