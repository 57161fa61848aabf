file(GLOB_RECURSE carom_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/cpp/src/*.cpp)
add_library(carom STATIC ${carom_sources})
add_library(carom::carom ALIAS carom)
target_compile_features(carom PUBLIC cxx_std_20)
set_target_properties(carom PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF)
target_include_directories(carom
  PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/cpp/include>
  PRIVATE ${PROJECT_SOURCE_DIR}/cpp/src)
target_link_libraries(carom PUBLIC Eigen3::Eigen PRIVATE $<BUILD_INTERFACE:carom_flags>)

# A file named x_avx2.cpp is compiled for that CPU level and chosen at run time. Such files take raw
# pointers and let no Eigen type cross their border (one-definition rule, alignment).
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(carom_avx2_sources ${carom_sources})
  list(FILTER carom_avx2_sources INCLUDE REGEX "_avx2\\.cpp$")
  set_source_files_properties(${carom_avx2_sources} PROPERTIES COMPILE_OPTIONS "-mavx2;-mfma")
endif()
# Vectors of four doubles pass between its own functions alone, so their calling convention without
# AVX matters to nobody; GCC says so once per file, where no pragma reaches.
set_source_files_properties(${PROJECT_SOURCE_DIR}/cpp/src/contact/bulk_kernel.cpp
  PROPERTIES COMPILE_OPTIONS "-Wno-psabi")

# Most of the time a source takes is Eigen's headers: read once. Files with flags of their own read them themselves.
target_precompile_headers(carom PRIVATE <Eigen/Core> <Eigen/Geometry> <cmath> <optional> <span> <string> <variant>
  <vector>)
set_source_files_properties(${carom_avx2_sources} ${PROJECT_SOURCE_DIR}/cpp/src/contact/bulk_kernel.cpp
  PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
