# Installs the build in BUILD below a folder of its own and looks whether everything lies where Debian expects it, and
# whether a configuration that somebody has written survives a second installation.
set(staging ${BUILD}/tests/staging)
file(REMOVE_RECURSE ${staging})
set(ENV{DESTDIR} ${staging})

function(install_it)
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix /usr RESULT_VARIABLE failed OUTPUT_QUIET)
  if(failed)
    message(FATAL_ERROR "cmake --install failed")
  endif()
endfunction()

install_it()
foreach(file usr/bin/graspd usr/lib/systemd/system/graspd.service etc/graspd/graspd.toml
             usr/share/doc/graspd/register-map.md usr/share/doc/graspd/log-codes.md usr/share/doc/graspd/graspd.toml
             usr/share/doc/graspd/part.toml usr/share/doc/graspd/calibration.toml)
  if(NOT EXISTS ${staging}/${file})
    message(FATAL_ERROR "not installed: /${file}")
  endif()
endforeach()
execute_process(COMMAND ${staging}/usr/bin/graspd --version RESULT_VARIABLE failed OUTPUT_VARIABLE said)
if(failed OR NOT said MATCHES "^graspd [0-9]")
  message(FATAL_ERROR "the installed graspd does not run: ${said}")
endif()
file(READ ${staging}/usr/lib/systemd/system/graspd.service unit)
if(NOT unit MATCHES "ExecStart=/usr/bin/graspd run --config /etc/graspd/graspd.toml")
  message(FATAL_ERROR "the unit does not start what is installed")
endif()

file(WRITE ${staging}/etc/graspd/graspd.toml "mine")
install_it()
file(READ ${staging}/etc/graspd/graspd.toml kept)
if(NOT kept STREQUAL "mine")
  message(FATAL_ERROR "a configuration was overwritten")
endif()
