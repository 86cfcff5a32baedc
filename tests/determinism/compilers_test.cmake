# See CMakeLists.txt beside this.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGV}\n${output}")
  endif()
endfunction()

# Builds with the compiler and the flags that follow, and sets `hashes` to those of its scenes.
function(hash_scenes name compiler)
  list(JOIN ARGN " " flags)
  set(build ${WORK_DIR}/${name})
  run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/project -B ${build} -G ${GENERATOR}
    -D CLEARWAY_DIR=${SOURCE_DIR} -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_CXX_FLAGS=${flags}
    -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
  run(${CMAKE_COMMAND} --build ${build} --parallel 2)
  execute_process(COMMAND ${build}/scene_hash RESULT_VARIABLE result OUTPUT_VARIABLE printed)
  message(STATUS "${name}:\n${printed}")
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "scene_hash of ${name} failed: ${result}")
  endif()
  set(hashes "${printed}" PARENT_SCOPE)
endfunction()

# As hash_scenes, and compares.
function(expect_the_same name)
  hash_scenes(${name} ${ARGN})
  if(NOT hashes STREQUAL expected)
    message(FATAL_ERROR "${name} makes other scenes than g++ -O0")
  endif()
endfunction()

# Without the functions for particular processors, and with them; then what processors with AVX2 but not AVX-512 do.
hash_scenes(g++-O0 g++ -O0 -DCLEARWAY_PORTABLE)
set(expected "${hashes}")
expect_the_same(g++-O2 g++ -O2)
expect_the_same(clang++-O0 clang++ -O0 -DCLEARWAY_PORTABLE)
expect_the_same(clang++-O2 clang++ -O2)
cmake_host_system_information(RESULT architecture QUERY OS_PLATFORM)
file(READ /proc/cpuinfo processors)
if(architecture STREQUAL "x86_64" AND processors MATCHES " avx2 ")
  expect_the_same(g++-avx2 g++ -O2 -DCLEARWAY_PORTABLE -mavx2)
endif()
