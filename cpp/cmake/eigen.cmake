# Unversioned on purpose: a request for 3.3 would refuse Eigen 5. The version is checked below.
find_package(Eigen3 QUIET CONFIG)

if(NOT TARGET Eigen3::Eigen AND PROJECT_IS_TOP_LEVEL)
  # The wheel cmeel-eigen keeps its files where CMake does not look: in site-packages/cmeel.prefix.
  find_package(Python QUIET COMPONENTS Interpreter)
  if(Python_FOUND)
    execute_process(COMMAND ${Python_EXECUTABLE} -c
      "import os, sys; print(';'.join(p + '/cmeel.prefix' for p in sys.path if os.path.isdir(p + '/cmeel.prefix')))"
      OUTPUT_VARIABLE carom_wheel_prefix OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    find_package(Eigen3 QUIET CONFIG PATHS ${carom_wheel_prefix} NO_DEFAULT_PATH)
  endif()
endif()
if(NOT TARGET Eigen3::Eigen)
  message(FATAL_ERROR
    "carom needs the Eigen headers (3.4 or later) and did not find them. On Debian and Ubuntu:\n"
    "    sudo apt install libeigen3-dev\n"
    "or from PyPI: pip install cmeel-eigen, then add its cmeel.prefix folder to CMAKE_PREFIX_PATH.")
endif()
if(Eigen3_VERSION VERSION_LESS 3.4)
  message(FATAL_ERROR "carom needs Eigen 3.4 or later; ${Eigen3_DIR} holds ${Eigen3_VERSION}.")
endif()
