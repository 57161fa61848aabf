# What every target of ours is compiled with. Warnings are errors in CI, not for users: a newer
# compiler must not break their build.
add_library(carom_flags INTERFACE)
target_compile_options(carom_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
  # Same bits for the same build and CPU level: fused multiply-add only where a kernel writes it.
  -ffp-contract=off
  # A parent project without a build type would compile the physics without optimisation.
  $<$<CONFIG:>:-O2> $<$<CONFIG:>:-DNDEBUG>
  $<$<BOOL:${CAROM_WARNINGS_AS_ERRORS}>:-Werror>)
if(CAROM_SANITIZE)
  target_compile_options(carom_flags INTERFACE -fsanitize=${CAROM_SANITIZE}
    -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(carom_flags INTERFACE -fsanitize=${CAROM_SANITIZE})
endif()
