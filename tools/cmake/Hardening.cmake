# SPDX-License-Identifier: Apache-2.0
# What makes a fault of the programs hard to use for an attack, as Debian's own build has it: a build without Debian's
# tools has it too. tests/package looks for it in the programs.
include(CheckCXXCompilerFlag)

add_library(dpslave_hardening INTERFACE)
foreach(flag -fstack-protector-strong -fstack-clash-protection -fcf-protection -mbranch-protection=standard)
  string(MAKE_C_IDENTIFIER "DPSLAVE_HAS${flag}" known)
  check_cxx_compiler_flag(${flag} ${known}) # the last two: of this processor only
  if(${known})
    target_compile_options(dpslave_hardening INTERFACE ${flag})
  endif()
endforeach()
# Position independent as a program is, not as a library: nothing of it can be replaced from outside, so calls stay direct.
target_compile_options(dpslave_hardening INTERFACE -fPIE)
target_link_options(dpslave_hardening INTERFACE -pie LINKER:-z,relro,-z,now)

# Calls of the C library that check their bounds. They need an optimised build; a sanitizer looks at more, and they would
# stand in its way. Debian's own build (no build type) brings the same definition.
if(NOT DPSLAVE_SANITIZE)
  set(DPSLAVE_FORTIFY $<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>)
endif()
