# `cmake --install`: where Debian expects things.

install(TARGETS graspd RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES configs/graspd.service DESTINATION lib/systemd/system)
install(FILES configs/register-map.md configs/log-codes.md configs/graspd.toml configs/part.toml
              configs/calibration.toml LICENSE
        DESTINATION ${CMAKE_INSTALL_DOCDIR})

# In /etc whatever the prefix, because the unit reads it there. A configuration that an integrator has written is kept;
# the example stands beside the register map.
install(CODE "
  set(configuration \"\$ENV{DESTDIR}/etc/graspd/graspd.toml\")
  if(EXISTS \"\${configuration}\")
    message(STATUS \"Kept: \${configuration}\")
  else()
    file(INSTALL \"${CMAKE_SOURCE_DIR}/configs/graspd.toml\" DESTINATION \"/etc/graspd\")
  endif()")
