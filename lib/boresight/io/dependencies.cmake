# What the room `io` needs beyond the other rooms: GiNaC (with CLN); toml++ is used as headers only.
find_path(BORESIGHT_TOML_INCLUDE toml++/toml.h REQUIRED)
find_path(BORESIGHT_GINAC_INCLUDE ginac/ginac.h REQUIRED)
mark_as_advanced(BORESIGHT_TOML_INCLUDE BORESIGHT_GINAC_INCLUDE)
target_link_libraries(boresight_io PRIVATE ginac cln)
