# Flags of every file of ours. Nothing depends on the machine that builds: the baseline is named, so that a -march=native in
# CXXFLAGS cannot leak in.
#   -ffp-contract=off        g++ fuses multiply and add under -mfma, across intrinsics too, which changes results between ISAs
#   -fno-tree-slp-vectorize  g++ 12.2's SLP vectoriser drops the rounding of (double)(float)x in some patterns at -O2
# tests/canaries/ holds a test for each.
add_library(lanecast_flags INTERFACE)
target_compile_options(lanecast_flags INTERFACE
  -march=x86-64 -mtune=generic
  -ffp-contract=off -fno-math-errno -fno-trapping-math
  $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>
  $<$<CXX_COMPILER_ID:Clang>:-fno-slp-vectorize>
  $<$<CONFIG:Debug>:-Og>
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow
  $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical> # in kernels, masks of width 1 are bools
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> # false alarm of g++ 12 on "literal" + std::string (GCC bug 105651)
  $<$<BOOL:${LANECAST_WERROR}>:-Werror>)

if(LANECAST_SANITIZE)
  set(sanitize -fsanitize=${LANECAST_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_compile_options(lanecast_flags INTERFACE ${sanitize})
  target_compile_definitions(lanecast_flags INTERFACE LANECAST_SANITIZED) # tests may run fewer cases
  add_link_options(-fsanitize=${LANECAST_SANITIZE})
endif()
