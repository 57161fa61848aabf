find_package(Python REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 CONFIG REQUIRED)
file(GLOB carom_bindings CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/cpp/bindings/*.cpp)
set(CMAKE_INTERPROCEDURAL_OPTIMIZATION OFF)  # pybind11 would link slowly; the hot code is not here
pybind11_add_module(carom_core ${carom_bindings})
set_target_properties(carom_core PROPERTIES OUTPUT_NAME _core CXX_EXTENSIONS OFF)
target_link_libraries(carom_core PRIVATE carom carom_flags)
target_compile_options(carom_core PRIVATE -Wno-pedantic -Wno-shadow)
target_compile_definitions(carom_core PRIVATE CAROM_VERSION="${PROJECT_VERSION}")

# In a wheel the build backend adds the Python files and picks the place. In a prefix, as colcon has
# them, they lie where Python finds them once the workspace is sourced.
set(carom_python_dir carom)
if(NOT DEFINED SKBUILD)
  set(carom_python_dir
    lib/python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}/site-packages/carom)
  install(DIRECTORY cpp/bindings/carom/ DESTINATION ${carom_python_dir}
    FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed"
    PATTERN "__pycache__" EXCLUDE)
endif()
install(TARGETS carom_core LIBRARY DESTINATION ${carom_python_dir})
install(DIRECTORY cpp/scenes/ DESTINATION ${carom_python_dir}/scenes PATTERN "*.png" EXCLUDE)
