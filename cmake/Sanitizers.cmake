# Builds that watch themselves: MEMS_STICTION_SANITIZE for scripts/sanitize, MEMS_STICTION_FUZZ for scripts/fuzz.
# Included before any target. A finding ends the program.
set(MEMS_STICTION_SANITIZE "" CACHE STRING
  "Compile everything with sanitizers: 'address' (and undefined behaviour), 'thread', or empty for none")
option(MEMS_STICTION_FUZZ "Build the fuzzing programs of test/fuzz, with address and undefined-behaviour sanitizers (needs clang)" OFF)

if(MEMS_STICTION_FUZZ AND NOT MEMS_STICTION_SANITIZE STREQUAL "address")
  set_property(CACHE MEMS_STICTION_SANITIZE PROPERTY VALUE address)
endif()
if(MEMS_STICTION_FUZZ AND NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  message(FATAL_ERROR "MEMS_STICTION_FUZZ needs clang with libFuzzer: -DCMAKE_CXX_COMPILER=clang++ (here: ${CMAKE_CXX_COMPILER})")
endif()

if(MEMS_STICTION_SANITIZE STREQUAL "address")
  set(sanitizers address,undefined)
elseif(MEMS_STICTION_SANITIZE STREQUAL "thread")
  set(sanitizers thread)
elseif(MEMS_STICTION_SANITIZE)
  message(FATAL_ERROR "MEMS_STICTION_SANITIZE: '${MEMS_STICTION_SANITIZE}' is not allowed, must be address, thread or empty")
endif()
if(sanitizers)
  add_compile_options(-fsanitize=${sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${sanitizers})
endif()
if(MEMS_STICTION_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
  # Looks every unknown name up among all that there are: most of the comparisons, and none that leads anywhere.
  set_source_files_properties(src/numeric/words.cpp PROPERTIES COMPILE_OPTIONS -fno-sanitize=fuzzer-no-link)
endif()
